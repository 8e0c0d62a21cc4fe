#include "framework/contact/surface/surface_rings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <unordered_map>

namespace tack {

template <class Item>
void SurfaceRings::Lists<Item>::fill(std::vector<std::pair<int, Item>> pairs, int keys) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  begin.assign(keys + 1, 0);
  items.reserve(pairs.size());
  for (const auto& [key, item] : pairs) {
    ++begin[key + 1];
    items.push_back(item);
  }
  for (int k = 0; k < keys; ++k) begin[k + 1] += begin[k];
}

SurfaceRings::SurfaceRings(const ContactSurface& surface) {
  const CollisionMesh& mesh = surface.mesh;
  const int vertices = static_cast<int>(mesh.vertex_object.size()), edges = static_cast<int>(mesh.edges.size());
  const auto key_of = [](int a, int b) { return static_cast<long long>(std::min(a, b)) << 32 | std::max(a, b); };
  std::unordered_map<long long, int> edge_index;
  edge_index.reserve(edges);
  std::vector<std::pair<int, int>> neighbours;
  for (int e = 0; e < edges; ++e) {
    const auto [a, b] = mesh.edges[e];
    edge_index.emplace(key_of(a, b), e);
    neighbours.insert(neighbours.end(), {{a, b}, {b, a}});
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours_.fill(std::move(neighbours), vertices);
  for (int v = 0; v < vertices; ++v) valence_max_ = std::max(valence_max_, static_cast<int>(neighbours_.of(v).size()));

  std::vector<std::pair<int, Edge>> fans;
  std::vector<std::pair<int, OppositeVertex>> opposite;
  two_sided_.assign(vertices, 0);
  vertex_area_.assign(vertices, 0);
  edge_area_.assign(edges, 0);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& corner = mesh.triangles[t];
    const Vec3 a = vertex(surface.rest, corner[0]);
    const double third = (vertex(surface.rest, corner[1]) - a).cross(vertex(surface.rest, corner[2]) - a).norm() / 6;
    std::array<int, 3>& own = edges_of_.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const int v = corner[i], next = corner[(i + 1) % 3], last = corner[(i + 2) % 3];
      fans.push_back({v, {next, last}});
      if (surface.two_sided[t]) two_sided_[v] = 1;
      own[i] = edge_index.at(key_of(v, next));
      opposite.push_back({own[i], {last, mesh.edges[own[i]][0] == v ? 1 : -1}});
      vertex_area_[v] += third;
      edge_area_[own[i]] += third;
    }
  }
  fans_.fill(std::move(fans), vertices);
  opposite_.fill(std::move(opposite), edges);
}

}  // namespace tack
