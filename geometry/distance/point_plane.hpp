// Squared distance from a point to the plane of a triangle [m^2]. Stacking: (p, t0, t1, t2).
// Needs a triangle of non-zero area; the clamped distance, which has no such limit, is
// point_triangle.hpp.
//
// The closest point has barycentric coordinates (1 - u - v, u, v), so r = sum_i w_i x_i with
// w = (1, u + v - 1, -u, -v), s = |r|^2, ds/dx_i = 2 w_i r. The vectors q_i of the Hessian (see
// plane_hessian) are the gradients of the barycentric coordinates in the triangle's plane.
#pragma once

#include "geometry/distance/span_projection.hpp"
#include "geometry/distance/stencil_derivatives.hpp"

namespace tack {

// u and v are the barycentric coordinates of t1 and t2.
inline PlaneProjection project_onto_triangle(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                             const Vec3& t2) {
  return project_onto_plane(p - t0, t0 - t1, t0 - t2);
}

inline double point_plane_distance(const Vec3& p, const Vec3& t0, const Vec3& t1, const Vec3& t2) {
  return project_onto_triangle(p, t0, t1, t2).residual.squaredNorm();
}

inline Eigen::Vector4d point_plane_weights(const PlaneProjection& plane) {
  return {1.0, plane.u + plane.v - 1.0, -plane.u, -plane.v};
}

inline StencilGradient<12> point_plane_gradient(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                                const Vec3& t2) {
  const PlaneProjection plane = project_onto_triangle(p, t0, t1, t2);
  return squared_length<4>(point_plane_weights(plane), plane.residual);
}

StencilDerivatives<12> point_plane_derivatives(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                               const Vec3& t2);

}  // namespace tack
