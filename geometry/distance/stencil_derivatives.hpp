// A scalar function of a stencil (a few vertices stacked into N = 3 * vertices coordinates), with
// its derivatives. For squared distances: value [m^2], gradient [m], hessian [1].
#pragma once

#include <Eigen/Core>

#include "geometry/types.hpp"

namespace tack {

template <int N>
struct StencilGradient {
  double value;
  Eigen::Matrix<double, N, 1> gradient;
};

template <int N>
struct StencilDerivatives {
  double value;
  Eigen::Matrix<double, N, 1> gradient;
  Eigen::Matrix<double, N, N> hessian;
};

// The Kronecker product w (x) r: block i is w_i r.
template <int V>
Eigen::Matrix<double, 3 * V, 1> stacked(const Eigen::Matrix<double, V, 1>& w, const Vec3& r) {
  Eigen::Matrix<double, 3 * V, 1> out;
  for (int i = 0; i < V; ++i) out.template segment<3>(3 * i) = w[i] * r;
  return out;
}

// Value and gradient of s = |r|^2, where r = sum_i w_i x_i is the shortest vector between two
// features. Because s is minimal in the parameters behind w, their variation drops out: ds/dx_i = 2
// w_i r.
template <int V>
StencilGradient<3 * V> squared_length(const Eigen::Matrix<double, V, 1>& w, const Vec3& r) {
  return {r.squaredNorm(), 2.0 * stacked<V>(w, r)};
}

}  // namespace tack
