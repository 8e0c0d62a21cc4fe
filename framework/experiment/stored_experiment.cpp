#include "framework/experiment/stored_experiment.hpp"

#include "framework/config/describe.hpp"
#include "framework/experiment/read_initial_state.hpp"
#include "framework/shapes/mesh_cache.hpp"

namespace tack {
namespace {

// The mesh of an object, which was read from a file when the state was stored.
class StoredMesh : public ShapeSource {
 public:
  explicit StoredMesh(Mesh mesh) : mesh_(std::move(mesh)) {}
  Mesh make() const override { return mesh_; }

 private:
  Mesh mesh_;
};

}  // namespace

StateFile state_file_of(StateFile::Kind kind, const Experiment& experiment) {
  StateFile file;
  file.kind = kind;
  file.scene = to_yaml(fields_of(experiment));
  // A checkpoint is resumed with the scene's own files.
  if (kind == StateFile::Kind::checkpoint) return file;
  for (const ObjectConfig& object : experiment.objects)
    if (object.shape->reads_files()) file.meshes[object.name] = mesh_of_shape(*object.shape)->mesh;
  return file;
}

LoadedExperiment experiment_of(const StateFile& file, const std::string& name, const std::vector<std::string>& overrides) {
  LoadedExperiment loaded = parse_experiment(file.scene, name, overrides);
  for (ObjectConfig& object : loaded.experiment.objects)
    if (const auto mesh = file.meshes.find(object.name); mesh != file.meshes.end())
      object.shape = std::make_unique<StoredMesh>(mesh->second);
  loaded.flowed = file.flowed;
  // The problem's own state is the start that is checked; the state file that the experiment
  // started from may no longer exist.
  if (!file.objects.empty()) {
    loaded.initial_state = initial_state_of(file, loaded.experiment, name);
    loaded.experiment.start.reset();
  }
  return loaded;
}

}  // namespace tack
