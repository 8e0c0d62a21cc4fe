// Squared distance between two points, s = |p0 - p1|^2 [m^2]. Stacking: (p0, p1).
#pragma once

#include "geometry/distance/stencil_derivatives.hpp"

namespace tack {

inline double point_point_distance(const Vec3& p0, const Vec3& p1) {
  return (p0 - p1).squaredNorm();
}

inline StencilGradient<6> point_point_gradient(const Vec3& p0, const Vec3& p1) {
  return squared_length<2>({1.0, -1.0}, p0 - p1);
}

inline StencilDerivatives<6> point_point_derivatives(const Vec3& p0, const Vec3& p1) {
  const auto [s, gradient] = point_point_gradient(p0, p1);
  StencilDerivatives<6> out{s, gradient, {}};
  out.hessian.setZero();
  out.hessian.diagonal().setConstant(2.0);
  out.hessian.diagonal<3>().setConstant(-2.0);
  out.hessian.diagonal<-3>().setConstant(-2.0);
  return out;
}

}  // namespace tack
