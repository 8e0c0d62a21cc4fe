#include "framework/contact/surface/surface_topology.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace tack {
namespace {

constexpr double crease_angle_min = 40 * M_PI / 180;  // between normals: an edge with a larger angle is a crease

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

void for_each_edge(const ContactSurface& surface,
                   const std::function<void(std::span<const EdgeUse> uses, std::optional<double> angle)>& visit) {
  const auto normal = [&](int t) {
    const auto c = corners(surface.rest, surface.mesh.triangles[t]);
    return Vec3((c[1] - c[0]).cross(c[2] - c[0]).normalized());
  };
  const std::vector<EdgeUse> uses = sorted_edge_uses(surface.mesh.triangles);
  for (auto first = uses.begin(), last = first; first != uses.end(); first = last) {
    last = std::find_if(first, uses.end(), [&](const EdgeUse& use) { return use.edge != first->edge; });
    std::optional<double> angle;
    if (last - first == 2)
      angle = std::acos(std::clamp(normal(first->triangle).dot(normal((first + 1)->triangle)), -1.0, 1.0));
    if (angle && *angle >= crease_angle_min) angle.reset();
    visit({first, last}, angle);
  }
}

namespace {

// Sets CSR lists of the elements of the given indices at each vertex.
template <class ElementAt>
void collect_at_vertices(const std::vector<int>& indices, size_t vertices, const ElementAt& element, std::vector<int>& start,
                         std::vector<int>& list) {
  start.assign(vertices + 1, 0);
  for (const int i : indices)
    for (const int v : element(i)) ++start[v + 1];
  for (size_t v = 0; v < vertices; ++v) start[v + 1] += start[v];
  list.resize(start.back());
  auto next = start;
  for (const int i : indices)
    for (const int v : element(i)) list[next[v]++] = i;
}

}  // namespace

SurfaceTopology::SurfaceTopology(const ContactSurface& surface) : two_sided_(surface.two_sided) {
  const size_t vertices = surface.mesh.vertex_object.size();
  find_incident(surface.mesh, vertices);
  find_rods(surface.mesh, vertices);
  find_particles(surface, vertices);
  find_creases(surface);
}

void SurfaceTopology::find_incident(const CollisionMesh& mesh, size_t vertices) {
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  collect_at_vertices(all, vertices, [&](int t) { return mesh.triangles[t]; }, start_, incident_);
}

void SurfaceTopology::find_rods(const CollisionMesh& mesh, size_t vertices) {
  if (mesh.codim_edges.empty()) return;
  collect_at_vertices(mesh.codim_edges, vertices, [&](int e) { return mesh.edges[e]; }, rod_start_, rods_);
}

void SurfaceTopology::find_particles(const ContactSurface& surface, size_t vertices) {
  if (surface.mesh.codim_points.empty()) return;
  radius_.assign(vertices, 0);
  for (const int v : surface.mesh.codim_points) radius_[v] = surface.particle_radius[surface.mesh.vertex_object[v]];
}

void SurfaceTopology::find_creases(const ContactSurface& surface) {
  smooth_edges_.assign(surface.mesh.triangles.size(), 0);
  smooth_vertex_.assign(start_.size() - 1, 1);
  for_each_edge(surface, [&](std::span<const EdgeUse> uses, const std::optional<double>& angle) {
    for (const EdgeUse& use : uses)
      if (angle) smooth_edges_[use.triangle] |= static_cast<unsigned char>(1u << use.side);
    for (const int v : uses[0].edge) smooth_vertex_[v] = smooth_vertex_[v] && angle;
  });
}

}  // namespace tack
