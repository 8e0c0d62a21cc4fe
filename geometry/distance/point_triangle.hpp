// Squared distance from a point to a triangle [m^2]. Stacking: (p, t0, t1, t2). Any input is
// allowed, also a triangle without area. C1 in the positions; the Hessian jumps where the type
// changes. The overloads that take a type trust it, so that one classification serves several
// calls.
#pragma once

#include "geometry/distance/closest_feature.hpp"
#include "geometry/distance/reduced_kernels.hpp"

namespace tack {

template <typename Kernels>
auto reduce_point_triangle(const Vec3& p, const Vec3& t0, const Vec3& t1, const Vec3& t2,
                           PointTriangleType type) {
  using enum PointTriangleType;
  switch (type) {
    case P_T0: return embed<4, 0, 1>(Kernels::point_point(p, t0));
    case P_T1: return embed<4, 0, 2>(Kernels::point_point(p, t1));
    case P_T2: return embed<4, 0, 3>(Kernels::point_point(p, t2));
    case P_E0: return embed<4, 0, 1, 2>(Kernels::point_line(p, t0, t1));
    case P_E1: return embed<4, 0, 2, 3>(Kernels::point_line(p, t1, t2));
    case P_E2: return embed<4, 0, 3, 1>(Kernels::point_line(p, t2, t0));
    case P_T: break;
  }
  return Kernels::point_plane(p, t0, t1, t2);
}

inline double point_triangle_distance(const Vec3& p, const Vec3& t0, const Vec3& t1, const Vec3& t2,
                                      PointTriangleType type) {
  return reduce_point_triangle<ValueKernels>(p, t0, t1, t2, type);
}
inline double point_triangle_distance(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                      const Vec3& t2) {
  return point_triangle_distance(p, t0, t1, t2, point_triangle_type(p, t0, t1, t2));
}

StencilGradient<12> point_triangle_gradient(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                            const Vec3& t2, PointTriangleType type);
inline StencilGradient<12> point_triangle_gradient(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                                   const Vec3& t2) {
  return point_triangle_gradient(p, t0, t1, t2, point_triangle_type(p, t0, t1, t2));
}

StencilDerivatives<12> point_triangle_derivatives(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                                  const Vec3& t2, PointTriangleType type);
inline StencilDerivatives<12> point_triangle_derivatives(const Vec3& p, const Vec3& t0,
                                                         const Vec3& t1, const Vec3& t2) {
  return point_triangle_derivatives(p, t0, t1, t2, point_triangle_type(p, t0, t1, t2));
}

// The shortest vector, from the triangle to the point [m].
inline Vec3 point_triangle_separation(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                      const Vec3& t2) {
  return reduce_point_triangle<SeparationKernels>(p, t0, t1, t2,
                                                  point_triangle_type(p, t0, t1, t2));
}

}  // namespace tack
