// Closest features of two primitives: the type of a clamped distance, which is one of point-point,
// point-line, point-plane or line-line. Types as in Li et al. 2020, "Incremental Potential
// Contact". Any input is allowed, also edges of length zero, triangles without area and parallel
// edges. On the border of two regions, where both distances are equal, the smaller feature is
// chosen (vertex before edge before face); between parallel edges, the pair searched first.
//
// Both searches use that the distance is a convex function of the parameters: if the unconstrained
// minimum lies inside, it is the result; otherwise the minimum lies on the boundary, on a
// point-edge pair. Degenerate input goes to the boundary directly.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "geometry/distance/line_line.hpp"
#include "geometry/distance/point_line.hpp"
#include "geometry/distance/point_plane.hpp"

namespace tack {

enum class PointEdgeType { P_E0, P_E1, P_E };

// Edges of the triangle: E0 = t0 t1, E1 = t1 t2, E2 = t2 t0.
enum class PointTriangleType { P_T0, P_T1, P_T2, P_E0, P_E1, P_E2, P_T };

enum class EdgeEdgeType {
  EA0_EB0,
  EA0_EB1,
  EA1_EB0,
  EA1_EB1,
  EA_EB0,
  EA_EB1,
  EA0_EB,
  EA1_EB,
  EA_EB
};

// The closest point of the segment e0 e1 to p: its type, its parameter in [0, 1], the squared
// distance.
struct PointEdgeClosest {
  PointEdgeType type;
  double parameter;
  double s;
};

inline PointEdgeClosest point_edge_closest(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  const Vec3 e = e1 - e0;
  const double along = e.dot(p - e0);
  if (!(along > 0.0)) return {PointEdgeType::P_E0, 0.0, (p - e0).squaredNorm()};
  if (!(e.dot(p - e1) < 0.0)) return {PointEdgeType::P_E1, 1.0, (p - e1).squaredNorm()};
  const auto [u, r] = project_onto_line(p, e0, e1);
  return {PointEdgeType::P_E, u, r.squaredNorm()};
}

inline PointEdgeType point_edge_type(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  return point_edge_closest(p, e0, e1).type;
}

// A point-edge pair of two larger primitives, with the types of its closest features there.
template <typename Type>
struct BoundaryPair {
  BoundaryPair(const Vec3& p, const Vec3& e0, const Vec3& e1, const std::array<Type, 3>& names) {
    const PointEdgeClosest closest = point_edge_closest(p, e0, e1);
    type = names[static_cast<int>(closest.type)];
    inside = closest.type == PointEdgeType::P_E;
    s = closest.s;
  }
  Type type;
  bool inside;
  double s;
};

// Returns the closest of all point-edge pairs. At a distance x from an end of an edge, the
// distances to edge and vertex differ by x^2 only. For x < 1e-8 a comparison of distances would
// choose either, and the gradient of the wrong one has an error of x. The signs that classify the
// pairs are more accurate: a pair of vertices belongs to two point-edge pairs, and is closest only
// if both have it.
template <typename Type, std::size_t N>
Type closest_boundary(const std::array<BoundaryPair<Type>, N>& pairs) {
  double smallest = std::numeric_limits<double>::infinity();
  double smallest_confirmed = smallest;
  Type type = pairs[0].type, confirmed_type = type;
  for (std::size_t i = 0; i < N; ++i) {
    bool confirmed = pairs[i].inside;
    for (std::size_t j = 0; j < N; ++j) confirmed |= j != i && pairs[j].type == pairs[i].type;
    if (confirmed && pairs[i].s < smallest_confirmed) {
      smallest_confirmed = pairs[i].s;
      confirmed_type = pairs[i].type;
    }
    if (pairs[i].s < smallest) {
      smallest = pairs[i].s;
      type = pairs[i].type;
    }
  }
  // No pair is confirmed, or it is by far not the closest: for degenerate input distances decide.
  return smallest_confirmed <= (1.0 + 1e-12) * smallest ? confirmed_type : type;
}

inline PointTriangleType point_triangle_type(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                             const Vec3& t2) {
  using enum PointTriangleType;
  if (!nearly_parallel(t1 - t0, t2 - t0)) {
    const PlaneProjection plane = project_onto_triangle(p, t0, t1, t2);
    if (plane.u > 0.0 && plane.v > 0.0 && plane.u + plane.v < 1.0) return P_T;
  }
  using Pair = BoundaryPair<PointTriangleType>;
  return closest_boundary(std::array{Pair(p, t0, t1, {P_T0, P_T1, P_E0}),
                                     Pair(p, t1, t2, {P_T1, P_T2, P_E1}),
                                     Pair(p, t2, t0, {P_T2, P_T0, P_E2})});
}

inline EdgeEdgeType edge_edge_type(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                   const Vec3& eb1) {
  using enum EdgeEdgeType;
  if (!nearly_parallel(ea1 - ea0, eb1 - eb0)) {
    const PlaneProjection plane = project_line_onto_line(ea0, ea1, eb0, eb1);
    if (plane.u > 0.0 && plane.u < 1.0 && plane.v > 0.0 && plane.v < 1.0) return EA_EB;
  }
  using Pair = BoundaryPair<EdgeEdgeType>;
  return closest_boundary(std::array{Pair(eb0, ea0, ea1, {EA0_EB0, EA1_EB0, EA_EB0}),
                                     Pair(eb1, ea0, ea1, {EA0_EB1, EA1_EB1, EA_EB1}),
                                     Pair(ea0, eb0, eb1, {EA0_EB0, EA0_EB1, EA0_EB}),
                                     Pair(ea1, eb0, eb1, {EA1_EB0, EA1_EB1, EA1_EB})});
}

}  // namespace tack
