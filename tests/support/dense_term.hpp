// Gradient and Hessian of a term as dense matrices, summed stencil by stencil, and the same from
// differences: what assembly and derivatives are tested against.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "framework/assembly/term_gradient.hpp"
#include "framework/core/term.hpp"

namespace tack {

using MatX = Eigen::MatrixXd;

inline VecX dense_gradient(const Term& term, const VecX& x) {
  VecX gradient = VecX::Zero(x.size());
  add_term_gradient(term, x, gradient);
  return gradient;
}

// The Hessian of each stencil as a matrix over all vertices; `visit` gets it with the stencil's
// rows and columns only, 3K x 3K, and its vertices.
template <class Visit>
void for_each_stencil_hessian(const Term& term, const VecX& x, SpdFilter filter, const Visit& visit) {
  const auto batches = term.batches();
  size_t gradients = 0, blocks = 0;
  for (const StencilBatch& b : batches) {
    gradients += static_cast<size_t>(b.arity) * b.count;
    blocks += static_cast<size_t>(hessian_blocks(b.arity)) * b.count;
  }
  std::vector<double> gradient(3 * gradients), hessian(9 * blocks);
  term.derivatives(x, filter, gradient.data(), hessian.data());
  const double* slot = hessian.data();
  for (const StencilBatch& b : batches) {
    for (int s = 0; s < b.count; ++s) {
      MatX h(3 * b.arity, 3 * b.arity);
      for (int i = 0; i < b.arity; ++i) {
        for (int j = 0; j <= i; ++j, slot += 9) {
          const Eigen::Map<const Mat3> block(slot);
          h.block<3, 3>(3 * i, 3 * j) = block;
          h.block<3, 3>(3 * j, 3 * i) = block.transpose();
        }
      }
      visit(h, b.vertices + b.arity * s);
    }
  }
}

inline MatX dense_hessian(const Term& term, const VecX& x, SpdFilter filter) {
  MatX sum = MatX::Zero(x.size(), x.size());
  for_each_stencil_hessian(term, x, filter, [&](const MatX& h, const int* v) {
    for (int i = 0; i < h.rows() / 3; ++i)
      for (int j = 0; j < h.rows() / 3; ++j)
        sum.block<3, 3>(3 * v[i], 3 * v[j]) += h.block<3, 3>(3 * i, 3 * j);
  });
  return sum;
}

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
template <class Value>
VecX gradient_by_differences(const Value& value, const VecX& x, double step) {
  VecX gradient(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    gradient(i) = central_difference([&](double h) { return value(x + h * VecX::Unit(x.size(), i)); }, step);
  return gradient;
}
template <class Gradient>
MatX hessian_by_differences(const Gradient& gradient, const VecX& x, double step) {
  MatX hessian(x.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    hessian.col(i) =
        central_difference([&](double h) { return gradient(x + h * VecX::Unit(x.size(), i)); }, step);
  return hessian;
}

inline double smallest_eigenvalue(const MatX& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatX>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

inline Vec3 total(const VecX& vectors) {
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < vectors.size() / 3; ++v) sum += vertex(vectors, v);
  return sum;
}
inline Vec3 total_moment(const VecX& x, const VecX& forces) {
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < x.size() / 3; ++v) sum += Vec3(vertex(x, v)).cross(Vec3(vertex(forces, v)));
  return sum;
}

}  // namespace tack
