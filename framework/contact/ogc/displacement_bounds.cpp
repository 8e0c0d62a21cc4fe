#include "framework/contact/ogc/displacement_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {

std::vector<double> displacement_bounds(const CollisionMesh& mesh, const Candidates& candidates, const VecX& x, double search_radius,
                                        double gamma) {
  std::vector<double> of_edge(mesh.edges.size(), search_radius), of_triangle(mesh.triangles.size(), search_radius);
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
