#include "framework/export/usd_prim.hpp"

#include <Eigen/Geometry>
#include <cctype>
#include <iterator>
#include <numeric>
#include <set>

#include "framework/export/chains.hpp"

namespace tack {
namespace {

constexpr const char* indent = "        ";

std::string list_of(const std::vector<int>& numbers) { return fmt::format("[{}]", fmt::join(numbers, ", ")); }

std::string quoted(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return '"' + escaped + '"';
}

std::string triple(const Vec3& v) { return fmt::format("({}, {}, {})", float(v[0]), float(v[1]), float(v[2])); }

std::vector<int> all_of(int count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// Returns the colours, one for the prim or one per face.
std::string colours(const ExportedObject& object, bool faces) {
  const bool constant = !faces || object.materials.size() == 1;
  std::string list;
  for (size_t f = 0; f < (constant ? 1 : object.face_material.size()); ++f)
    list += (f ? ", " : "") + triple(object.materials[constant ? 0 : object.face_material[f]].colour);
  return fmt::format("{0}color3f[] primvars:displayColor = [{1}] (\n{0}    interpolation = \"{2}\"\n{0})\n", indent, list, constant ? "constant" : "uniform");
}

// Returns a subset of faces for each material of an .obj file, with its name.
std::string material_subsets(const ExportedObject& object) {
  if (object.materials.size() == 1 && object.materials[0].name == object.file_name) return "";
  std::string text = fmt::format("{}uniform token subsetFamily:materialBind:familyType = \"partition\"\n", indent);
  std::set<std::string> taken;
  for (size_t m = 0; m < object.materials.size(); ++m) {
    std::vector<int> faces;
    for (size_t f = 0; f < object.face_material.size(); ++f)
      if (object.face_material[f] == static_cast<int>(m)) faces.push_back(static_cast<int>(f));
    std::string name = usd_identifier(object.materials[m].name);
    while (!taken.insert(name).second) name += "_";
    text += fmt::format("\n{0}def GeomSubset \"{1}\"\n{0}{{\n{0}    uniform token elementType = \"face\"\n{0}    uniform token familyName = \"materialBind\"\n"
                        "{0}    int[] indices = {2}\n{0}}}\n", indent, name, list_of(faces));
  }
  return text;
}

std::string common(const ExportedObject& object) { return fmt::format("{}custom string tack:object = {}\n", indent, quoted(object.name)); }

std::string mesh_properties(const ExportedObject& object) {
  std::string text = common(object);
  text += fmt::format("{0}uniform bool doubleSided = 1\n{0}uniform token subdivisionScheme = \"none\"\n{0}int[] faceVertexCounts = {1}\n{0}int[] faceVertexIndices = {2}\n", indent,
                      list_of(object.face_sizes), list_of(object.corners));
  if (!object.corner_uvs.empty()) {
    std::string uvs;
    for (const Vec2& uv : object.uvs) uvs += fmt::format("{}({}, {})", uvs.empty() ? "" : ", ", float(uv[0]), float(uv[1]));
    text += fmt::format("{0}texCoord2f[] primvars:st = [{1}] (\n{0}    interpolation = \"faceVarying\"\n{0})\n{0}int[] primvars:st:indices = {2}\n", indent, uvs,
                        list_of(object.corner_uvs));
  }
  return text + colours(object, true) + material_subsets(object);
}

std::string widths(double width) {
  return width > 0 ? fmt::format("{0}float[] widths = [{1}] (\n{0}    interpolation = \"constant\"\n{0})\n", indent, float(width)) : "";
}

UsdPrim curves(const ExportedObject& object, const std::string& name, double width) {
  UsdPrim prim{"BasisCurves", name, {}, width, common(object)};
  std::vector<int> counts;
  for (const auto& chain : chains_of(object.edges)) {
    counts.push_back(static_cast<int>(chain.size()));
    prim.vertices.insert(prim.vertices.end(), chain.begin(), chain.end());
  }
  prim.properties += fmt::format("{0}uniform token type = \"linear\"\n{0}uniform token wrap = \"nonperiodic\"\n{0}int[] curveVertexCounts = {1}\n", indent, list_of(counts));
  prim.properties += widths(width) + colours(object, false);
  return prim;
}

}  // namespace

std::string usd_identifier(const std::string& name) {
  std::string identifier;
  for (const unsigned char c : name) identifier += c < 0x80 && std::isalnum(c) ? static_cast<char>(c) : '_';
  if (identifier.empty() || std::isdigit(static_cast<unsigned char>(identifier[0]))) identifier.insert(0, "_");
  return identifier;
}

std::vector<UsdPrim> usd_prims(const ExportedObject& object, const std::string& name, double scale) {
  std::vector<UsdPrim> prims;
  const auto next_name = [&](const char* ending) { return prims.empty() ? name : name + ending; };
  const double width = 2 * object.radius * scale;
  if (object.has_faces()) prims.push_back({"Mesh", name, all_of(object.vertices), 0, mesh_properties(object)});
  if (!object.edges.empty()) prims.push_back(curves(object, next_name("_curves"), width));
  if (!object.points.empty()) prims.push_back({"Points", next_name("_points"), object.points, width, common(object) + widths(width) + colours(object, false)});
  return prims;
}

void append_points(fmt::memory_buffer& text, const std::vector<int>& vertices, const std::vector<Vec3>& x, double scale) {
  text.push_back('[');
  for (size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 p = scale * x[vertices[i]];
    fmt::format_to(std::back_inserter(text), "{}({}, {}, {})", i ? ", " : "", float(p[0]), float(p[1]), float(p[2]));
  }
  text.push_back(']');
}

void append_extent(fmt::memory_buffer& text, const UsdPrim& prim, const std::vector<Vec3>& x, double scale) {
  Eigen::AlignedBox3d box;
  for (const int v : prim.vertices) box.extend(Vec3(scale * x[v]));
  const Vec3 margin = Vec3::Constant(prim.width / 2);
  fmt::format_to(std::back_inserter(text), "[{}, {}]", triple(box.min() - margin), triple(box.max() + margin));
}

}  // namespace tack
