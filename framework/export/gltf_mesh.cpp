#include "framework/export/gltf_mesh.hpp"

#include <algorithm>
#include <map>

#include "geometry/io/polygon.hpp"

namespace tack {
namespace {

// Numbers the vertices of a file: one for each pair of vertex and texture coordinates in use.
class VertexNumbers {
 public:
  VertexNumbers(const ExportedObject& object, GltfMesh& mesh) : object_(object), mesh_(mesh) {}

  // uv: -1 for none.
  int of(int vertex, int uv) {
    const auto [place, is_new] = numbers_.try_emplace({vertex, uv}, static_cast<int>(mesh_.vertices.size()));
    if (is_new) {
      mesh_.vertices.push_back(vertex);
      if (!object_.corner_uvs.empty()) mesh_.uvs.push_back(uv < 0 ? Vec2::Zero() : object_.uvs[uv]);
    }
    return place->second;
  }

 private:
  const ExportedObject& object_;
  GltfMesh& mesh_;
  std::map<std::pair<int, int>, int> numbers_;
};

void add_faces(const ExportedObject& object, const std::vector<Vec3>& x, VertexNumbers& numbers, std::vector<GltfMesh::Primitive>& primitives) {
  const size_t first_primitive = primitives.size();
  for (size_t m = 0; m < object.materials.size(); ++m) primitives.push_back({4, static_cast<int>(m), {}});
  Mesh cut;
  cut.vertices = x;
  size_t first = 0;
  for (size_t f = 0; f < object.face_sizes.size(); ++f) {
    const std::vector<int> polygon(object.corners.begin() + first, object.corners.begin() + first + object.face_sizes[f]);
    cut.triangles.clear();
    add_polygon(cut, polygon, object.name);
    for (const Triangle& t : cut.triangles)
      for (const int v : t) {
        const auto corner = first + (std::find(polygon.begin(), polygon.end(), v) - polygon.begin());
        primitives[first_primitive + object.face_material[f]].indices.push_back(numbers.of(v, object.corner_uvs.empty() ? -1 : object.corner_uvs[corner]));
      }
    first += polygon.size();
  }
  std::erase_if(primitives, [](const GltfMesh::Primitive& p) { return p.indices.empty(); });
}

}  // namespace

GltfMesh gltf_mesh(const ExportedObject& object, const std::vector<Vec3>& x) {
  GltfMesh mesh;
  VertexNumbers numbers(object, mesh);
  if (object.corner_uvs.empty())  // in the order of the object
    for (int v = 0; v < object.vertices; ++v) numbers.of(v, -1);
  add_faces(object, x, numbers, mesh.primitives);
  if (!object.edges.empty()) {
    GltfMesh::Primitive& lines = mesh.primitives.emplace_back(GltfMesh::Primitive{1, 0, {}});
    for (const Edge& e : object.edges)
      for (const int v : e) lines.indices.push_back(numbers.of(v, -1));
  }
  if (!object.points.empty()) {
    GltfMesh::Primitive& points = mesh.primitives.emplace_back(GltfMesh::Primitive{0, 0, {}});
    for (const int v : object.points) points.indices.push_back(numbers.of(v, -1));
  }
  return mesh;
}

}  // namespace tack
