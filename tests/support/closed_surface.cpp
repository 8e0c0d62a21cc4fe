#include "tests/support/closed_surface.hpp"

#include <map>

namespace tack {

bool is_closed_manifold(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> directed;
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) ++directed[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : directed) {
    const auto back = directed.find({edge[1], edge[0]});
    if (count != 1 || back == directed.end() || back->second != 1) return false;
  }
  return !triangles.empty();
}

int euler_characteristic(const Surface& surface) {
  return static_cast<int>(surface.vertices.size()) - static_cast<int>(surface.edges.size()) +
         static_cast<int>(surface.triangles.size());
}

double enclosed_volume(const Mesh& mesh, const std::vector<Triangle>& triangles) {
  double volume = 0;
  for (const auto& [a, b, c] : triangles) {
    volume += mesh.vertices[a].cross(mesh.vertices[b]).dot(mesh.vertices[c]) / 6;
  }
  return volume;
}

}  // namespace tack
