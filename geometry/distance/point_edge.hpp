// Squared distance from a point to a segment [m^2]. Stacking: (p, e0, e1). Any input is allowed,
// also an edge of length zero. C1 in the positions; the Hessian jumps where the type changes.
#pragma once

#include "geometry/distance/closest_feature.hpp"
#include "geometry/distance/reduced_kernels.hpp"

namespace tack {

template <typename Kernels>
auto reduce_point_edge(const Vec3& p, const Vec3& e0, const Vec3& e1, PointEdgeType type) {
  if (type == PointEdgeType::P_E0) return embed<3, 0, 1>(Kernels::point_point(p, e0));
  if (type == PointEdgeType::P_E1) return embed<3, 0, 2>(Kernels::point_point(p, e1));
  return embed<3, 0, 1, 2>(Kernels::point_line(p, e0, e1));
}

inline double point_edge_distance(const Vec3& p, const Vec3& e0, const Vec3& e1,
                                  PointEdgeType type) {
  return reduce_point_edge<ValueKernels>(p, e0, e1, type);
}
inline double point_edge_distance(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  return point_edge_closest(p, e0, e1).s;
}

StencilGradient<9> point_edge_gradient(const Vec3& p, const Vec3& e0, const Vec3& e1,
                                       PointEdgeType type);
inline StencilGradient<9> point_edge_gradient(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  return point_edge_gradient(p, e0, e1, point_edge_type(p, e0, e1));
}

StencilDerivatives<9> point_edge_derivatives(const Vec3& p, const Vec3& e0, const Vec3& e1,
                                             PointEdgeType type);
inline StencilDerivatives<9> point_edge_derivatives(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  return point_edge_derivatives(p, e0, e1, point_edge_type(p, e0, e1));
}

// The shortest vector, from the edge to the point [m].
inline Vec3 point_edge_separation(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  return reduce_point_edge<SeparationKernels>(p, e0, e1, point_edge_type(p, e0, e1));
}

}  // namespace tack
