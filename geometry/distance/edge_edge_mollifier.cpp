#include "geometry/distance/edge_edge_mollifier.hpp"

namespace tack {

Mat12 edge_edge_cross_squared_hessian(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                      const Vec3& eb1) {
  const Vec3 a = ea1 - ea0, b = eb1 - eb0;
  const Mat3 identity = Mat3::Identity();
  const Mat3 aa = 2.0 * (b.squaredNorm() * identity - b * b.transpose());
  const Mat3 bb = 2.0 * (a.squaredNorm() * identity - a * a.transpose());
  const Mat3 ab = 4.0 * a * b.transpose() - 2.0 * b * a.transpose() - 2.0 * a.dot(b) * identity;
  Mat12 hessian;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const double sign = i == j ? 1.0 : -1.0;
      hessian.block<3, 3>(3 * i, 3 * j) = sign * aa;
      hessian.block<3, 3>(3 * i, 6 + 3 * j) = sign * ab;
      hessian.block<3, 3>(6 + 3 * i, 3 * j) = sign * ab.transpose();
      hessian.block<3, 3>(6 + 3 * i, 6 + 3 * j) = sign * bb;
    }
  }
  return hessian;
}

StencilDerivatives<12> edge_edge_mollifier_derivatives(const Vec3& ea0, const Vec3& ea1,
                                                       const Vec3& eb0, const Vec3& eb1,
                                                       double eps_x) {
  const auto [c, gradient] = edge_edge_cross_squared_gradient(ea0, ea1, eb0, eb1);
  if (!(c < eps_x)) return {1.0, Vec12::Zero(), Mat12::Zero()};
  const double slope = mollifier_slope(c, eps_x);
  StencilDerivatives<12> out{mollifier_value(c, eps_x), slope * gradient, {}};
  out.hessian = slope * edge_edge_cross_squared_hessian(ea0, ea1, eb0, eb1) +
                (mollifier_curvature(c, eps_x) * gradient) * gradient.transpose();
  return out;
}

}  // namespace tack
