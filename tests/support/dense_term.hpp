// Gradient and Hessian of a term as dense matrices: summed over stencils, and from
// finite differences. Tests compare assembly and derivatives with them.
#pragma once

#include <functional>

#include "framework/core/term.hpp"

namespace tack {

using MatX = Eigen::MatrixXd;

VecX dense_gradient(const Term& term, const VecX& x);
MatX dense_hessian(const Term& term, const VecX& x, Projection projection);

// The Hessian of each stencil as a matrix over its own rows and columns only, 3K x 3K, with its
// vertices.
using VisitStencil = std::function<void(const MatX& hessian, const int* vertices)>;
void for_each_stencil_hessian(const Term& term, const VecX& x, Projection projection,
                              const VisitStencil& visit);

// f'(0) from fourth-order central differences of f(-2h), f(-h), f(h), f(2h); numbers or vectors.
template <class F>
auto central_difference(const F& f, double h) {
  const auto far_high = f(2 * h), high = f(h), low = f(-h), far_low = f(-2 * h);
  auto derivative = (8 * (high - low) - (far_high - far_low)) / (12 * h);
  if constexpr (std::is_arithmetic_v<decltype(derivative)>) {
    return derivative;
  } else {
    return VecX(derivative);
  }
}

// Derivatives of value(x) and gradient(x) in every coordinate; `step` in metres.
VecX gradient_by_differences(const std::function<double(const VecX&)>& value, const VecX& x,
                             double step);
MatX hessian_by_differences(const std::function<VecX(const VecX&)>& gradient, const VecX& x,
                            double step);

double smallest_eigenvalue(const MatX& symmetric);
// The projection by a full eigenvalue decomposition.
MatX projected(const MatX& symmetric, Projection projection);

// Sums over all vertices.
Vec3 total(const VecX& vectors);
Vec3 total_moment(const VecX& x, const VecX& forces);

}  // namespace tack
