// Displacement bounds of Offset Geometric Contact: how far each vertex may move, in any direction
// and together with all others, without surfaces passing through each other:
//     b_v = gamma min(r_q, d_v, min over triangles t at v of d_t, min over edges e at v of d_e),
// with the distances d of vertices to triangles, triangles to vertices and edges to edges that they
// share no vertex with, and the search radius r_q. gamma < 1/2: both sides may move.
// Source: Chen et al. 2025, Offset Geometric Contact, ACM TOG 44(4), conservative displacement
// bounds.
//
// The model `ogc` does not truncate displacements: one continuous collision detection per line
// search gives the largest step along a Newton direction, which the bounds would change to another
// direction without descent. The bounds are the test of the search: no motion within them may
// touch.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// candidates: all pairs closer than the search radius at x (3n) [m]. Returns a bound for each
// global vertex [m]; infinity for vertices of no surface.
inline std::vector<double> displacement_bounds(const CollisionMesh& mesh,
                                               const Candidates& candidates, const VecX& x,
                                               double search_radius, double gamma = 0.45) {
  std::vector<double> of_edge(mesh.edges.size(), search_radius),
      of_triangle(mesh.triangles.size(), search_radius);
  std::vector<double> bounds(mesh.vertex_object.size(), std::numeric_limits<double>::infinity());
  for (const int v : mesh.vertices) bounds[v] = search_radius;
  const auto lower = [](double& bound, double distance) { bound = std::min(bound, distance); };
  for (const auto& [p, t] : candidates.point_triangle) {
    const auto [a, b, c] = corners(x, mesh.triangles[t]);
    const double d = std::sqrt(point_triangle_distance(vertex(x, p), a, b, c));
    lower(bounds[p], d);
    lower(of_triangle[t], d);
  }
  for (const auto& [e, f] : candidates.edge_edge) {
    const auto [a0, a1] = corners(x, mesh.edges[e]);
    const auto [b0, b1] = corners(x, mesh.edges[f]);
    const double d = std::sqrt(edge_edge_distance(a0, a1, b0, b1));
    lower(of_edge[e], d);
    lower(of_edge[f], d);
  }
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int v : mesh.triangles[t]) lower(bounds[v], of_triangle[t]);
  for (size_t e = 0; e < mesh.edges.size(); ++e)
    for (const int v : mesh.edges[e]) lower(bounds[v], of_edge[e]);
  for (double& b : bounds) b *= gamma;
  return bounds;
}

}  // namespace tack
