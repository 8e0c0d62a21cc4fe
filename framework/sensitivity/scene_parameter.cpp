#include "framework/sensitivity/scene_parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "framework/config/parse.hpp"
#include "framework/config/written_number.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& why) {
  throw InputError(fmt::format("output.gradients: '{}' {}", key, why));
}

bool same_meshes(const World& a, const World& b) {
  if (a.bodies.size() != b.bodies.size() || a.rest.size() != b.rest.size() || a.dofs.size() != b.dofs.size() || a.tets != b.tets) return false;
  for (size_t i = 0; i < a.bodies.size(); ++i)
    if (a.bodies[i].triangles != b.bodies[i].triangles || a.bodies[i].edges != b.bodies[i].edges || a.bodies[i].points != b.bodies[i].points) return false;
  return true;
}

// Returns the text of the number in the resolved scene.
WrittenNumber number_at(const BuiltExperiment& run, const std::string& key) {
  const Value resolved = to_value(fields_of(run.experiment()));
  const Value* value = value_at(resolved, key);
  if (!value) refuse(key, "is no key of the scene; scene.yaml of its results has all of them");
  if (value->is_null()) refuse(key, "has no value in the scene; give it one, or use the key that determines it");
  const std::optional<WrittenNumber> number = value->is_scalar() ? written_number(value->text) : std::nullopt;
  if (!number) refuse(key, fmt::format("is {}, not a number", value->description()));
  return *number;
}

}  // namespace

double scene_parameter(const BuiltExperiment& run, const std::string& key) {
  constexpr std::array fixed = {"name", "about", "plugins", "time", "solver", "output", "expect", "start"};
  const std::string top = key.substr(0, key.find('.'));
  if (std::find(fixed.begin(), fixed.end(), top) != fixed.end())
    refuse(key, "is a setting of the run and not of the model: sensitivities exist to parameters of objects, contact and loads");
  return number_at(run, key).si;
}

LoadedExperiment scene_with(const BuiltExperiment& run, const std::string& key, double value) {
  // The value keeps its unit, on which expressions of a parameter depend.
  Value root = run.root(), number = Value::scalar(number_at(run, key).text_of(value)), none = Value::sequence();
  none.mark.file = std::make_shared<const std::string>("output.gradients: " + key);
  number.mark.file = std::make_shared<const std::string>("output.gradients: " + key);
  set_at(root, key, std::move(number));
  set_at(root, "output.gradients", std::move(none));
  return bound_experiment(std::move(root));
}

std::unique_ptr<BuiltExperiment> built_with(const BuiltExperiment& run, const std::string& key, double value) {
  auto built = std::make_unique<BuiltExperiment>(scene_with(run, key, value));
  if (!same_meshes(run.world(), built->world())) refuse(key, "changes meshes or unknowns, so that states cannot be compared");
  return built;
}

}  // namespace tack
