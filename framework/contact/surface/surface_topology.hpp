// Topology of the surfaces, constant through the run: the triangles and rods at each vertex, and
// which edges and vertices of a triangle are smooth, so that the surface continues beyond them
// without a crease. An edge is smooth if exactly two triangles meet there at less than 40 degrees
// at rest; a vertex is smooth if all its edges are.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "framework/contact/stencils/contact_set.hpp"

namespace tack {

// An edge of a triangle.
struct EdgeUse {
  Edge edge;  // its vertices ascending
  int triangle;
  int side;  // of the triangle: from its corner `side` to the next
};

// Calls visit(uses, angle) for every edge: uses: the triangles that meet there; angle: between
// their normals at rest if the edge is smooth [rad], none otherwise.
void for_each_edge(
    const ContactSurface& surface,
    const std::function<void(std::span<const EdgeUse> uses, std::optional<double> angle)>& visit);

class SurfaceTopology {
 public:
  explicit SurfaceTopology(const ContactSurface& surface);

  std::span<const int> triangles_at(int vertex_index) const {
    return {incident_.data() + start_[vertex_index], incident_.data() + start_[vertex_index + 1]};
  }
  // Edges that are in no triangle.
  std::span<const int> rods_at(int vertex_index) const {
    if (rod_start_.empty()) return {};
    return {rods_.data() + rod_start_[vertex_index], rods_.data() + rod_start_[vertex_index + 1]};
  }
  // Radius of a particle; 0 for other vertices [m].
  double particle_radius(int vertex_index) const {
    return radius_.empty() ? 0 : radius_[vertex_index];
  }
  // Returns whether the vertex belongs to a rod, or is a particle.
  bool is_codimensional(int vertex_index) const {
    return !rods_at(vertex_index).empty() || particle_radius(vertex_index) > 0;
  }
  bool smooth_vertex(int vertex_index) const { return smooth_vertex_[vertex_index] != 0; }
  // Edge i of a triangle: from its corner i to the next.
  bool smooth_edge(int triangle, int i) const { return (smooth_edges_[triangle] >> i & 1) != 0; }
  // Returns whether the triangle belongs to a sheet, which has two sides.
  bool two_sided(int triangle) const { return two_sided_[triangle] != 0; }

 private:
  void find_incident(const CollisionMesh& mesh, size_t vertices);
  void find_rods(const CollisionMesh& mesh, size_t vertices);
  void find_particles(const ContactSurface& surface, size_t vertices);
  void find_creases(const ContactSurface& surface);

  std::vector<int> start_, incident_;        // triangles at each global vertex
  std::vector<int> rod_start_, rods_;        // rods at each global vertex; empty without rods
  std::vector<double> radius_;               // per global vertex; empty without particles
  std::vector<char> smooth_vertex_;          // per global vertex
  std::vector<unsigned char> smooth_edges_;  // per triangle, a bit an edge
  std::vector<char> two_sided_;              // per triangle
};

}  // namespace tack
