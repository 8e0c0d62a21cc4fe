#include "solvers/minimizers/convergence_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/minimizers/shifted_factor.hpp"

namespace tack {
namespace {

// Factor on the gradient at which the next norm is computed, to be early rather than late.
constexpr double sooner = 1.5;

}  // namespace

ConvergenceJudge::ConvergenceJudge() : linear_(Registry<LinearSolver>::make("lagged_cholesky")) {}

void ConvergenceJudge::begin() {
  begun_ = false;
  asked_ = next_asked_ = 0;
}

double ConvergenceJudge::stopping_norm(const MinimizerProblem& problem, MinimizerResult& result) {
  VecX p;
  if (!problem.norm_of_direction) return problem.stopping_norm(p, problem.objective.gradient());
  const BlockMatrix& hessian = problem.objective.hessian({Projection::clamp});
  if (!newton_solve(*linear_, hessian, problem.objective.gradient(), p, problem.clock, result))
    return std::numeric_limits<double>::infinity();
  return check_.norm(*linear_, hessian, problem, p, result);
}

bool ConvergenceJudge::converged(const MinimizerProblem& problem, MinimizerResult& result) {
  if (!problem.norm_of_direction) {
    result.residual = problem.stopping_norm(VecX(), problem.objective.gradient());
    return result.residual <= 1 && balanced(problem, result);
  }
  const double gradient = problem.objective.gradient().norm();
  ++asked_;
  if (begun_ && gradient > next_gradient_) {
    if (problem.true_residuals && std::isfinite(gradient) && asked_ >= next_asked_) {
      next_asked_ = std::max(asked_ + 1, asked_ < 20 ? 0 : asked_ + asked_ / 10);
      result.residual = stopping_norm(problem, result);
    }
    return false;
  }
  if (!std::isfinite(gradient)) return false;
  begun_ = true;
  result.residual = stopping_norm(problem, result);
  const bool done = result.residual <= 1 && balanced(problem, result);
  next_gradient_ = gradient * std::min(sooner / result.residual, 0.9);
  return done;
}

}  // namespace tack
