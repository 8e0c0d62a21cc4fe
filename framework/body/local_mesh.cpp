#include "framework/body/local_mesh.hpp"

namespace tack {

Mesh local_mesh(const Body& body, const VecX& rest) {
  Mesh mesh;
  for (int v = 0; v < body.vertex_count; ++v) mesh.vertices.push_back(vertex(rest, body.first_vertex + v));
  const auto shifted = [&](auto elements) {
    for (auto& element : elements)
      for (int& v : element) v -= body.first_vertex;
    return elements;
  };
  mesh.tets = shifted(body.tets);
  mesh.triangles = shifted(body.sheet);
  mesh.edges = shifted(body.edges);
  for (const int v : body.points) mesh.points.push_back(v - body.first_vertex);
  return mesh;
}

}  // namespace tack
