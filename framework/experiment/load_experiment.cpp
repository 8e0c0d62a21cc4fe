#include "framework/experiment/load_experiment.hpp"

#include <fmt/format.h>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/experiment/file_kind.hpp"
#include "framework/output/state_file.hpp"
#include "framework/plugin/plugins.hpp"
#include "geometry/errors.hpp"

namespace tack {

namespace {

void refuse_former_keys(const Value& root) {
  if (const Value* springs = root.find("springs"))
    throw InputError(springs->mark.text() + ": springs are interactions: write `interactions: [{type: spring, ...}]`, with the same keys");
}

// Equal names would be ambiguous in a formula of probes.
void refuse_names_of_probes(const Value& root) {
  const Value *parameters = root.find("parameters"), *probes = root.find("probes");
  if (!parameters || !probes) return;
  for (const Value& probe : probes->items)
    if (const Value* name = probe.find("name"); name && parameters->find(name->text))
      throw InputError(fmt::format("{}: the probe '{}' has the name of a parameter; give one of them another", name->mark.text(), name->text));
}

}  // namespace

LoadedExperiment bound_experiment(Value root) {
  refuse_other_kind(root, FileKind::scene);
  refuse_former_keys(root);
  refuse_names_of_probes(root);
  load_plugins(root);
  LoadedExperiment loaded{std::move(root), {}, {}, {}};
  bind(loaded.root, loaded.experiment, "the scene");
  const auto fills = [](const ObjectConfig& object) { return object.fill.has_value(); };
  if (std::none_of(loaded.experiment.objects.begin(), loaded.experiment.objects.end(), fills)) return loaded;
  LoadedExperiment whole{expand_fills(std::move(loaded.root), loaded.experiment), {}, {}, {}};
  bind(whole.root, whole.experiment, "the scene");
  return whole;
}

LoadedExperiment load_experiment(const std::string& path, const std::vector<std::string>& overrides) {
  if (begins_as_state_file(path))
    throw InputError(fmt::format("{}: this is a stored step or a checkpoint of a run, not a scene; `tack solve` solves a stored step, `tack compare` compares solvers on it, and `tack run "
                                 "--resume` goes on from the newest checkpoint", path));
  return bound_experiment(with_overrides(parse_file(path), overrides));
}

LoadedExperiment parse_experiment(const std::string& text, const std::string& name, const std::vector<std::string>& overrides) {
  return bound_experiment(with_overrides(parse_string(text, name), overrides));
}

}  // namespace tack
