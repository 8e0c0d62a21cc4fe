// Squared distance from a point to the infinite line through e0 and e1 [m^2]. Stacking: (p, e0,
// e1). Needs e0 != e1; the clamped distance to a segment, which has no such limit, is
// point_edge.hpp.
//
// With e = e1 - e0, the closest point e0 + u e, r = p - e0 - u e = sum_i w_i x_i, w = (1, u - 1,
// -u), W = dw/du = (0, 1, -1), q = dual vector of dr/du = -e, and P = I - e e^T / |e|^2:
//   s = |r|^2, ds/dx_i = 2 w_i r,
//   1/2 d2s/dx_i dx_j = w_i w_j P - W_i w_j r q^T - w_i W_j q r^T - W_i W_j r r^T / |e|^2.
#pragma once

#include "geometry/distance/span_projection.hpp"
#include "geometry/distance/stencil_derivatives.hpp"

namespace tack {

inline LineProjection project_onto_line(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  return project_onto_line(p - e0, e0 - e1);
}

inline double point_line_distance(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  return project_onto_line(p, e0, e1).residual.squaredNorm();
}

inline StencilGradient<9> point_line_gradient(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  const auto [u, r] = project_onto_line(p, e0, e1);
  return squared_length<3>({1.0, u - 1.0, -u}, r);
}

StencilDerivatives<9> point_line_derivatives(const Vec3& p, const Vec3& e0, const Vec3& e1);

}  // namespace tack
