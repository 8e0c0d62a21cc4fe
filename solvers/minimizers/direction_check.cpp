#include "solvers/minimizers/direction_check.hpp"

#include <algorithm>
#include <limits>

namespace tack {
namespace {

constexpr int most_corrections = 20;
constexpr double slowest = 0.5;  // fraction of the error that a correction may leave
constexpr double margin = 0.5;                    // target, as a fraction of the tolerated error
constexpr double tightest = 1e-3, loosest = 0.3;  // relative residuals of corrections

}  // namespace

double DirectionCheck::norm(LinearSolver& linear, const BlockMatrix& hessian, const MinimizerProblem& problem,
                            VecX& p, MinimizerResult& result) {
  const VecX& gradient = problem.objective.gradient();
  double norm = problem.stopping_norm(p, gradient);
  if (!problem.norm_of_direction || !problem.direction_error) return norm;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; norm <= 1; ++i) {
    {
      const PhaseScope scope(problem.clock, Phase::solve);
      product_.multiply(hessian, p, residual_);
      residual_ = -gradient - residual_;
    }
    const double error = problem.direction_error(residual_);
    if (norm + error <= 1 || i == most_corrections || !(error <= slowest * before)) return norm + error;
    before = error;
    ++result.linear_solves;
    linear.correct(residual_, correction_, std::clamp(margin * (1 - norm) / error, tightest, loosest),
                   problem.clock);
    result.linear_iterations += linear.iterations();
    if (!correction_.allFinite()) return norm + error;
    p += correction_;
    norm = problem.stopping_norm(p, gradient);
  }
  return norm;
}

}  // namespace tack
