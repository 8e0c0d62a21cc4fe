// Objectives of a few blocks of three unknowns with closed forms, for tests of minimisers.
#pragma once

#include <Eigen/Eigenvalues>
#include <functional>

#include "framework/core/minimizer.hpp"
#include "tests/support/component_variants.hpp"

namespace tack {

// Value, gradient and dense Hessian as functions of all unknowns. Blocks of the Hessian that are
// zero at `pattern_at` are not stored.
class FormulaObjective : public Objective {
 public:
  struct Formula {
    std::function<double(const VecX&)> value;
    std::function<VecX(const VecX&)> gradient;
    std::function<Eigen::MatrixXd(const VecX&)> hessian;
  };
  FormulaObjective(Formula formula, const VecX& pattern_at)
      : formula_(std::move(formula)), q_(pattern_at) {
    const Eigen::MatrixXd dense = formula_.hessian(q_);
    const auto n = dense.rows() / 3;
    matrix_.column_start.push_back(0);
    for (Eigen::Index c = 0; c < n; ++c) {
      for (Eigen::Index r = c; r < n; ++r)
        if (r == c || !dense.block<3, 3>(3 * r, 3 * c).isZero(0))
          matrix_.row.push_back(static_cast<int>(r));
      matrix_.column_start.push_back(matrix_.blocks());
    }
    matrix_.values.resize(9 * matrix_.row.size());
    matrix_.version = 1;
  }

  int size() const override { return static_cast<int>(q_.size()); }
  void move_to(const VecX& q) override { q_ = q; }
  double value() override {
    ++count_;
    return formula_.value(q_);
  }
  double value_noise() const override { return 0; }
  const VecX& gradient() override { return gradient_ = formula_.gradient(q_); }
  // Projection: of the whole matrix, within the pattern.
  const BlockMatrix& hessian(const HessianRequest& request) override {
    Eigen::MatrixXd dense = formula_.hessian(q_);
    if (request.projection == Projection::clamp) {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense);
      dense = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() *
              solver.eigenvectors().transpose();
    }
    for (int c = 0; c < matrix_.columns(); ++c)
      for (int k = matrix_.column_start[c]; k < matrix_.column_start[c + 1]; ++k)
        matrix_.block(k) = dense.block<3, 3>(3 * matrix_.row[k], 3 * c);
    return matrix_;
  }
  int value_count() const override { return count_; }

 private:
  Formula formula_;
  VecX q_, gradient_;
  BlockMatrix matrix_;
  int count_ = 0;
};

// A chain of n particles between fixed ends: 1/2 q . A q - b . q, A = tridiagonal (-1, 2, -1) in
// each of the three directions, with its minimum at q = minimum.
inline FormulaObjective chain(int n, const VecX& minimum) {
  Eigen::MatrixXd a = 2 * Eigen::MatrixXd::Identity(3 * n, 3 * n);
  for (int i = 0; i + 3 < 3 * n; ++i) a(i, i + 3) = a(i + 3, i) = -1;
  return FormulaObjective(
      {[=](const VecX& q) { return 0.5 * (q - minimum).dot(a * (q - minimum)); },
       [=](const VecX& q) { return VecX(a * (q - minimum)); }, [=](const VecX&) { return a; }},
      minimum);
}

// Where a minimiser ended on a chain from q = 0, and how far from the minimum.
struct ChainEnd {
  MinimizerResult result;
  VecX error;
};
// minimizer: YAML. tolerance: of the largest component of the direction. feasible: part of every
// step.
inline ChainEnd minimize_chain(int particles, const std::string& minimizer, double tolerance,
                               double feasible = 1) {
  const VecX minimum = VecX::LinSpaced(3 * particles, 1, 2);
  FormulaObjective objective = chain(particles, minimum);
  PhaseClock clock;
  VecX q = VecX::Zero(3 * particles);
  const MinimizerProblem problem{
      objective, [=](const VecX&, const VecX&) { return feasible; },
      [=](const VecX& p, const VecX&) { return p.lpNorm<Eigen::Infinity>() / tolerance; }, clock};
  const MinimizerResult result = component<Minimizer>(minimizer)->minimize(problem, q);
  return {result, q - minimum};
}

}  // namespace tack
