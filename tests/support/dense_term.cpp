#include "tests/support/dense_term.hpp"

#include <Eigen/Eigenvalues>
#include <vector>

#include "framework/core/term_gradient.hpp"

namespace tack {

VecX dense_gradient(const Term& term, const VecX& x) {
  VecX gradient = VecX::Zero(x.size());
  add_term_gradient(term, x, gradient);
  return gradient;
}

void for_each_stencil_hessian(const Term& term, const VecX& x, Projection projection, const VisitStencil& visit) {
  const auto batches = term.batches();
  size_t gradients = 0, blocks = 0;
  for (const StencilBatch& b : batches) {
    gradients += static_cast<size_t>(b.arity) * b.count;
    blocks += static_cast<size_t>(hessian_blocks(b.arity)) * b.count;
  }
  std::vector<double> gradient(3 * gradients), hessian(9 * blocks);
  term.derivatives(x, projection, gradient.data(), hessian.data());
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

MatX dense_hessian(const Term& term, const VecX& x, Projection projection) {
  MatX sum = MatX::Zero(x.size(), x.size());
  for_each_stencil_hessian(term, x, projection, [&](const MatX& h, const int* v) {
    for (int i = 0; i < h.rows() / 3; ++i)
      for (int j = 0; j < h.rows() / 3; ++j)
        sum.block<3, 3>(3 * v[i], 3 * v[j]) += h.block<3, 3>(3 * i, 3 * j);
  });
  return sum;
}

VecX gradient_by_differences(const std::function<double(const VecX&)>& value, const VecX& x, double step) {
  VecX gradient(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    gradient(i) = central_difference([&](double h) { return value(x + h * VecX::Unit(x.size(), i)); }, step);
  return gradient;
}

MatX hessian_by_differences(const std::function<VecX(const VecX&)>& gradient, const VecX& x, double step) {
  MatX hessian(x.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    hessian.col(i) =
        central_difference([&](double h) { return gradient(x + h * VecX::Unit(x.size(), i)); }, step);
  return hessian;
}

double smallest_eigenvalue(const MatX& symmetric) {
  return Eigen::SelfAdjointEigenSolver<MatX>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

MatX projected(const MatX& symmetric, Projection projection) {
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(symmetric);
  const VecX values = eigen.eigenvalues().unaryExpr([&](double v) { return projected(v, projection); });
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

Vec3 total(const VecX& vectors) {
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < vectors.size() / 3; ++v) sum += vertex(vectors, v);
  return sum;
}

Vec3 total_moment(const VecX& x, const VecX& forces) {
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < x.size() / 3; ++v) sum += Vec3(vertex(x, v)).cross(Vec3(vertex(forces, v)));
  return sum;
}

}  // namespace tack
