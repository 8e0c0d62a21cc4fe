// Animated glTF 2.0 as one .glb file. The first sample is the mesh of an object, each other sample a
// morph target: displacements from the first. The animation moves the weight from one target to the
// next, so that positions are interpolated linearly between samples. Objects that never move have
// no targets.
#include <algorithm>

#include "framework/export/gltf_buffer.hpp"
#include "framework/export/gltf_mesh.hpp"
#include "framework/export/shape_format.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"
#include "geometry/spaced_indices.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Layers of a texture array that every WebGL 2 has (OpenGL ES 3.0, table 6.28): three.js keeps each
// morph target in one.
constexpr int layers_guaranteed = 256;
constexpr double roughness = 0.7;  // of surfaces, that of tack render (report/src/studio.js)

// An object of the file and what it needs of each sample.
struct GltfObject {
  GltfMesh mesh;
  std::vector<Vec3> first;                     // positions in the first sample [m]
  std::vector<std::vector<Vec3>> displacements;  // of the further samples [m]
  bool moves = false;
};

class GltfFormat : public ShapeFormat {
 public:
  void fields(Fields& f) override {
    ShapeFormat::fields(f);
    f.integer("frames", frames_, "largest number of samples; of more, as many are taken evenly").range(2, layers_guaranteed);
    f.number("speed", speed_, units::none, "simulated seconds per second of the animation").positive();
  }

 protected:
  std::string default_output(const std::string& run) const override { return run + ".glb"; }
  bool writes_one_file() const override { return true; }
  void check_output(const fs::path& path) const override {
    if (path.extension() != ".glb") throw InputError(fmt::format("{}: names of binary glTF files end in .glb; give one with -o", path.string()));
  }

  void write_run(const RunShapes& run, const fs::path& path, std::vector<std::string>& notes) const override {
    const int count = static_cast<int>(run.times().size());
    const std::vector<int> samples = spaced_indices(count, frames_);
    if (static_cast<int>(samples.size()) < count)
      notes.push_back(fmt::format("{} of {} samples are written; more by frames=N, at most {}", samples.size(), count, layers_guaranteed));
    const std::vector<GltfObject> objects = objects_of(run, samples);
    GltfBuffer buffer;
    Json gltf = {{"asset", {{"version", "2.0"}, {"generator", "tack"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
    add_objects(run, objects, buffer, gltf);
    add_animation(run, samples, objects, buffer, gltf);
    std::error_code failed;  // writing reports the error
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), failed);
    try {
      replace_file(path, buffer.file(std::move(gltf)));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
  }

 private:
  static std::vector<GltfObject> objects_of(const RunShapes& run, const std::vector<int>& samples) {
    std::vector<GltfObject> objects(run.objects().size());
    run.visit([&](int sample, const ObjectPositions& x) {
      if (!std::binary_search(samples.begin(), samples.end(), sample)) return;
      for (size_t k = 0; k < objects.size(); ++k) {
        GltfObject& object = objects[k];
        if (sample == 0) {
          object.mesh = gltf_mesh(run.objects()[k], x[k]);
          object.first = picked(x[k], object.mesh.vertices);
          continue;
        }
        std::vector<Vec3> displacement = picked(x[k], object.mesh.vertices);
        for (size_t v = 0; v < displacement.size(); ++v) {
          displacement[v] -= object.first[v];
          object.moves = object.moves || displacement[v] != Vec3::Zero();
        }
        object.displacements.push_back(std::move(displacement));
      }
    });
    return objects;
  }

  // Node 0 is the parent of all, node k + 1 has object k.
  static void add_objects(const RunShapes& run, const std::vector<GltfObject>& objects, GltfBuffer& buffer, Json& gltf) {
    Json nodes = Json::array({{{"name", run.name()}, {"children", Json::array()}}});
    if (std::abs(run.up().z()) > std::abs(run.up().y())) nodes[0]["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // z up becomes y up
    Json meshes = Json::array(), materials = Json::array();
    for (size_t k = 0; k < objects.size(); ++k) {
      const ExportedObject& object = run.objects()[k];
      const int first_material = static_cast<int>(materials.size());
      for (const ExportedMaterial& m : object.materials)
        materials.push_back({{"name", m.name}, {"doubleSided", true},
                             {"pbrMetallicRoughness", {{"baseColorFactor", {m.colour[0], m.colour[1], m.colour[2], 1}}, {"metallicFactor", 0}, {"roughnessFactor", roughness}}}});
      Json attributes = {{"POSITION", buffer.add_vectors(objects[k].first)}};
      if (!objects[k].mesh.uvs.empty()) attributes["TEXCOORD_0"] = buffer.add_uvs(objects[k].mesh.uvs);
      Json targets = Json::array();
      if (objects[k].moves)
        for (const auto& displacement : objects[k].displacements) targets.push_back({{"POSITION", buffer.add_vectors(displacement)}});
      Json primitives = Json::array();
      for (const GltfMesh::Primitive& p : objects[k].mesh.primitives) {
        primitives.push_back({{"attributes", attributes}, {"indices", buffer.add_indices(p.indices)}, {"mode", p.mode}, {"material", first_material + p.material}});
        if (objects[k].moves) primitives.back()["targets"] = targets;
      }
      meshes.push_back({{"name", object.name}, {"primitives", std::move(primitives)}});
      if (objects[k].moves) meshes.back()["weights"] = std::vector<float>(targets.size(), 0);
      nodes.push_back({{"name", object.name}, {"mesh", k}});
      nodes[0]["children"].push_back(k + 1);
    }
    gltf["nodes"] = std::move(nodes);
    gltf["meshes"] = std::move(meshes);
    gltf["materials"] = std::move(materials);
  }

  // Weight i - 1 is 1 at sample i, and 0 at all others.
  void add_animation(const RunShapes& run, const std::vector<int>& samples, const std::vector<GltfObject>& objects, GltfBuffer& buffer, Json& gltf) const {
    if (std::none_of(objects.begin(), objects.end(), [](const GltfObject& o) { return o.moves; })) return;
    std::vector<float> times, weights;
    for (size_t i = 0; i < samples.size(); ++i) {
      times.push_back(static_cast<float>((run.times()[samples[i]] - run.times().front()) / speed_));
      for (size_t target = 1; target < samples.size(); ++target) weights.push_back(target == i ? 1 : 0);
    }
    const int input = buffer.add_numbers(times, true), output = buffer.add_numbers(weights, false);
    Json channels = Json::array();
    for (size_t k = 0; k < objects.size(); ++k)
      if (objects[k].moves) channels.push_back({{"sampler", 0}, {"target", {{"node", k + 1}, {"path", "weights"}}}});
    gltf["animations"] = {{{"name", run.name()}, {"channels", std::move(channels)}, {"samplers", {{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}}}}};
  }

  int frames_ = 100;
  double speed_ = 1;
};
TACK_REGISTER(OutputFormat, GltfFormat, "gltf",
              "One animated .glb file for browsers: samples as morph targets, with materials and texture coordinates. Coordinates in metres, y up.", "");

}  // namespace
}  // namespace tack
