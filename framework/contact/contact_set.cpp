#include "framework/contact/contact_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/assembly/parallel.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {

double smallest_distance(const CollisionMesh& mesh, const Candidates& candidates, const VecX& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto smallest = [&](const auto& pairs, const auto& squared) {
    return min_chunks(static_cast<int>(pairs.size()), infinity, [&](int first, int last) {
      double s = infinity;
      for (int i = first; i < last; ++i) s = std::min(s, squared(pairs[i][0], pairs[i][1]));
      return s;
    });
  };
  const auto at = [&](int v) { return Vec3(vertex(x, v)); };
  const double points = smallest(candidates.point_triangle, [&](int p, int t) {
    const Triangle& f = mesh.triangles[t];
    return point_triangle_distance(at(p), at(f[0]), at(f[1]), at(f[2]));
  });
  const double edges = smallest(candidates.edge_edge, [&](int i, int j) {
    const Edge &a = mesh.edges[i], &b = mesh.edges[j];
    return edge_edge_distance(at(a[0]), at(a[1]), at(b[0]), at(b[1]));
  });
  const double rods = smallest(candidates.point_edge, [&](int p, int e) {
    return point_edge_closest(at(p), at(mesh.edges[e][0]), at(mesh.edges[e][1])).s;
  });
  const double particles = smallest(candidates.point_point,
                                    [&](int a, int b) { return (at(a) - at(b)).squaredNorm(); });
  return std::sqrt(std::min({points, edges, rods, particles}));
}

}  // namespace tack
