#include "framework/experiment/read_initial_state.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "framework/experiment/load_experiment.hpp"
#include "framework/output/checkpoints.hpp"
#include "framework/setup/interaction_builder.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

fs::path checkpoint_of(const fs::path& from) {
  if (!fs::is_directory(from)) return from;
  for (const fs::path& folder : {from / "checkpoints", from})
    if (fs::path newest = newest_checkpoint_in(folder); !newest.empty()) return newest;
  throw InputError(fmt::format("there is no checkpoint in {}; run that experiment with output.checkpoint_interval", from.string()));
}

}  // namespace

InitialStateFromRun initial_state_of(const StateFile& file, const Experiment& experiment, const std::string& name) {
  InitialStateFromRun state{name, file.state.time, file.state.x, file.state.v, file.state.a, file.state.history, file.objects, {}, {}};
  for (const ObjectConfig& object : experiment.objects) state.order.push_back(object.name), state.energies[object.name] = energies_text(object);
  for (size_t i = 0; i < experiment.interactions.size(); ++i) state.energies[interaction_name(experiment, i)] = "";
  const Eigen::Index vertices = file.state.x.size() / 3;
  check_size(file, vertices, name);
  for (const auto& [object, there] : file.objects) {
    const bool fits = there.vertices.size() >= there.mesh.vertex_count && state.energies.contains(object) &&
                      std::all_of(there.vertices.begin(), there.vertices.end(), [&](int v) { return v >= 0 && v < vertices; });
    if (!fits) throw InputError(fmt::format("{}: its object '{}' does not fit its state; write it anew", name, object));
  }
  return state;
}

InitialStateFromRun read_initial_state(const std::string& from) {
  const fs::path path = checkpoint_of(from);
  const StateFile file = read_state_file(path, StateFile::Kind::checkpoint);
  if (file.objects.empty())
    throw InputError(fmt::format("{}: was written by an earlier program, which did not note whose vertices are whose; write it anew", path.string()));
  return initial_state_of(file, parse_experiment(file.scene, path.string()).experiment, path.string());
}

}  // namespace tack
