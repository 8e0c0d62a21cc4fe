#include "framework/contact/surface_topology.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tack {
namespace {

const double crease = std::cos(40 * M_PI / 180);  // of the angle between the normals beyond which it is one

// An edge of a triangle, with its vertices ascending.
struct EdgeUse {
  Edge edge;
  int triangle, side;
};

std::vector<EdgeUse> sorted_edge_uses(const std::vector<Triangle>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
      uses.push_back({{a, b}, static_cast<int>(t), i});
    }
  std::stable_sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.edge < b.edge; });
  return uses;
}

}  // namespace

SurfaceTopology::SurfaceTopology(const ContactSurface& surface) {
  for (const int object : surface.mesh.vertex_object) two_sided_.push_back(!surface.closed[object]);
  find_incident(surface.mesh, two_sided_.size());
  find_creases(surface);
}

void SurfaceTopology::find_incident(const CollisionMesh& mesh, size_t vertices) {
  start_.assign(vertices + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) ++start_[v + 1];
  for (size_t v = 0; v < vertices; ++v) start_[v + 1] += start_[v];
  incident_.resize(start_.back());
  auto next = start_;
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t]) incident_[next[v]++] = static_cast<int>(t);
}

void SurfaceTopology::find_creases(const ContactSurface& surface) {
  const auto& triangles = surface.mesh.triangles;
  const auto normal = [&](int t) {
    const Vec3 a = vertex(surface.rest, triangles[t][0]);
    return Vec3((vertex(surface.rest, triangles[t][1]) - a)
                    .cross(vertex(surface.rest, triangles[t][2]) - a).normalized());
  };
  smooth_edges_.assign(triangles.size(), 0);
  smooth_vertex_.assign(two_sided_.size(), 1);
  const std::vector<EdgeUse> uses = sorted_edge_uses(triangles);
  for (size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].edge == uses[first].edge) ++last;
    const bool smooth =
        last - first == 2 && normal(uses[first].triangle).dot(normal(uses[first + 1].triangle)) > crease;
    for (size_t i = first; smooth && i < last; ++i)
      smooth_edges_[uses[i].triangle] |= static_cast<unsigned char>(1u << uses[i].side);
    for (const int v : uses[first].edge) smooth_vertex_[v] = smooth_vertex_[v] && smooth;
  }
}

}  // namespace tack
