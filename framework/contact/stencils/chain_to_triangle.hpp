// The chain rule for a point p = sum_i b_i a_i inside a triangle (a_0, a_1, a_2): derivatives by
// (p, rest) become derivatives by (a_0, a_1, a_2, rest).
#pragma once

#include "geometry/distance/stencil_derivatives.hpp"

namespace tack {

inline double chain_to_triangle(double value, const Vec3& /*b*/) { return value; }

template <int N>
Eigen::Matrix<double, N + 6, 1> chain_to_triangle(const Eigen::Matrix<double, N, 1>& g,
                                                  const Vec3& b) {
  Eigen::Matrix<double, N + 6, 1> out;
  for (int i = 0; i < 3; ++i) out.template segment<3>(3 * i) = b[i] * g.template head<3>();
  out.template tail<N - 3>() = g.template tail<N - 3>();
  return out;
}

template <int N>
Eigen::Matrix<double, N + 6, N + 6> chain_to_triangle(const Eigen::Matrix<double, N, N>& h,
                                                      const Vec3& b) {
  Eigen::Matrix<double, N + 6, N + 6> out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      out.template block<3, 3>(3 * i, 3 * j) = b[i] * b[j] * h.template topLeftCorner<3, 3>();
    out.template block<3, N - 3>(3 * i, 9) = b[i] * h.template topRightCorner<3, N - 3>();
    out.template block<N - 3, 3>(9, 3 * i) = b[i] * h.template bottomLeftCorner<N - 3, 3>();
  }
  out.template bottomRightCorner<N - 3, N - 3>() = h.template bottomRightCorner<N - 3, N - 3>();
  return out;
}

template <int N>
StencilGradient<N + 6> chain_to_triangle(const StencilGradient<N>& s, const Vec3& b) {
  return {s.value, chain_to_triangle<N>(s.gradient, b)};
}

template <int N>
StencilDerivatives<N + 6> chain_to_triangle(const StencilDerivatives<N>& s, const Vec3& b) {
  return {s.value, chain_to_triangle<N>(s.gradient, b), chain_to_triangle<N>(s.hessian, b)};
}

}  // namespace tack
