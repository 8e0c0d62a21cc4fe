#include "framework/contact/ogc/feasible_cones.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tack {
namespace {

bool leads_away(const Vec3& d, const Vec3& tangent) {
  return d.dot(tangent) <= cone_cosine_max * std::sqrt(d.squaredNorm() * tangent.squaredNorm());
}

}  // namespace

bool in_vertex_cone(const SurfaceRings& rings, const VecX& x, int vertex_index, const Vec3& d) {
  const Vec3 at = vertex(x, vertex_index);
  if (!std::ranges::all_of(rings.neighbours(vertex_index), [&](int n) { return leads_away(d, vertex(x, n) - at); }))
    return false;
  return rings.two_sided(vertex_index) || std::ranges::any_of(rings.fan(vertex_index), [&](const Edge& other) {
           return (vertex(x, other[0]) - at).cross(vertex(x, other[1]) - at).dot(d) >= 0;
         });
}

bool in_edge_cone(const SurfaceRings& rings, const CollisionMesh& mesh, const VecX& x, int edge, const Vec3& d) {
  const std::array<Vec3, 2> ends = corners(x, mesh.edges[edge]);
  const Vec3 along = ends[1] - ends[0];
  const bool within = std::ranges::all_of(rings.opposite(edge), [&](const OppositeVertex& o) {
    const Vec3 q = vertex(x, o.vertex) - ends[0];
    return leads_away(d, q - q.dot(along) / along.squaredNorm() * along);
  });
  return within && outside_edge(rings, mesh, x, edge, d);
}

bool outside_edge(const SurfaceRings& rings, const CollisionMesh& mesh, const VecX& x, int edge, const Vec3& d) {
  const auto [a, b] = mesh.edges[edge];
  if (rings.two_sided(a) || rings.two_sided(b)) return true;
  const Vec3 at = vertex(x, a), along = vertex(x, b) - at;
  return std::ranges::any_of(rings.opposite(edge), [&](const OppositeVertex& o) {
    return o.orientation * along.cross(vertex(x, o.vertex) - at).dot(d) >= 0;
  });
}

}  // namespace tack
