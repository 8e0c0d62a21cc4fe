// Shapes of a run as arrays for NumPy: OBJECT.npy, positions [m] as doubles of shape (samples,
// vertices, 3), and shapes.json with the times and the faces, edges, points, materials and radius of
// each object.
#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "framework/export/draft_files.hpp"
#include "framework/export/shape_format.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little);

// Returns the header of an array of doubles (NumPy, "NPY format", version 1.0): its length is a
// multiple of 64.
std::string npy_header(size_t samples, int vertices) {
  std::string text = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}, 3), }}", samples, vertices);
  constexpr size_t before = 10, multiple = 64;
  text.resize((before + text.size() + multiple) / multiple * multiple - before, ' ');
  text.back() = '\n';
  const auto length = static_cast<unsigned>(text.size());
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(length & 0xffU) + static_cast<char>(length >> 8) + text;
}

Json json_of(const ExportedObject& o) {
  Json materials = Json::array(), uvs = Json::array(), edges = Json::array();
  for (const ExportedMaterial& m : o.materials) materials.push_back({{"name", m.name}, {"colour", {m.colour.x(), m.colour.y(), m.colour.z()}}});
  for (const Vec2& uv : o.uvs) uvs.push_back({uv.x(), uv.y()});
  for (const Edge& e : o.edges) edges.push_back({e[0], e[1]});
  return {{"name", o.name}, {"positions", o.file_name + ".npy"}, {"vertices", o.vertices}, {"face_sizes", o.face_sizes}, {"corners", o.corners},
          {"uvs", uvs}, {"corner_uvs", o.corner_uvs}, {"materials", materials}, {"face_material", o.face_material}, {"edges", edges},
          {"points", o.points}, {"radius", o.radius}};
}

class NpyFormat : public ShapeFormat {
 protected:
  std::string default_output(const std::string&) const override { return "npy"; }
  void write_run(const RunShapes& run, const fs::path& folder, std::vector<std::string>&) const override {
    DraftFiles files;
    std::vector<int> arrays;
    Json objects = Json::array();
    for (const ExportedObject& object : run.objects()) {
      arrays.push_back(files.begin(folder / (object.file_name + ".npy")));
      files.append(arrays.back(), npy_header(run.times().size(), object.vertices));
      objects.push_back(json_of(object));
    }
    run.visit([&](int, const ObjectPositions& x) {
      for (size_t k = 0; k < arrays.size(); ++k)
        files.append(arrays[k], {reinterpret_cast<const char*>(x[k].data()), x[k].size() * sizeof(Vec3)});
    });
    const Vec3 up = run.up();
    const Json all = {{"name", run.name()}, {"up", {up.x(), up.y(), up.z()}}, {"times", run.times()}, {"objects", objects}};
    files.append(files.begin(folder / "shapes.json"), all.dump(-1, ' ', false, Json::error_handler_t::replace));  // names of materials need not be UTF-8
    files.commit();
  }
};
TACK_REGISTER(OutputFormat, NpyFormat, "npy",
              "Arrays for NumPy: a folder with OBJECT.npy, positions of shape (samples, vertices, 3), and shapes.json with the times and the faces, edges "
              "and points of each object.", "");

}  // namespace
}  // namespace tack
