// Squared distance between two infinite lines [m^2]. Stacking: (ea0, ea1, eb0, eb1).
// Needs lines that are not parallel; the clamped distance between edges, which has no such limit,
// is edge_edge.hpp.
//
// The closest points are ea0 + u a and eb0 + v b with a = ea1 - ea0, b = eb1 - eb0, so
// r = sum_i w_i x_i with w = (1 - u, u, v - 1, -v), s = |r|^2, ds/dx_i = 2 w_i r; the Hessian is
// plane_hessian. It grows like s / sin^2 of the angle between the lines (see
// edge_edge_mollifier.hpp).
#pragma once

#include "geometry/distance/span_projection.hpp"
#include "geometry/distance/stencil_derivatives.hpp"

namespace tack {

inline PlaneProjection project_line_onto_line(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                              const Vec3& eb1) {
  return project_onto_plane(ea0 - eb0, ea1 - ea0, eb0 - eb1);
}

inline double line_line_distance(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                 const Vec3& eb1) {
  return project_line_onto_line(ea0, ea1, eb0, eb1).residual.squaredNorm();
}

inline Eigen::Vector4d line_line_weights(const PlaneProjection& plane) {
  return {1.0 - plane.u, plane.u, plane.v - 1.0, -plane.v};
}

inline StencilGradient<12> line_line_gradient(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                              const Vec3& eb1) {
  const PlaneProjection plane = project_line_onto_line(ea0, ea1, eb0, eb1);
  return squared_length<4>(line_line_weights(plane), plane.residual);
}

StencilDerivatives<12> line_line_derivatives(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                             const Vec3& eb1);

}  // namespace tack
