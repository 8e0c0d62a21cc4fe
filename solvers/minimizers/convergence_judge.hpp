// Convergence test of methods whose own direction does not measure the distance to the minimum
// (gradient methods, external minimisers), by the criterion of Newton's method. If that criterion
// needs the Newton direction, one system is solved for it: at the start, and again when the
// gradient has fallen to the value that the last test asked for.
#pragma once

#include <memory>

#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"
#include "solvers/minimizers/direction_check.hpp"

namespace tack {

class ConvergenceJudge {
 public:
  ConvergenceJudge();
  void begin();  // begins a minimisation
  // Returns true if the objective's present point has converged. result.residual is the last norm.
  bool converged(const MinimizerProblem& problem, MinimizerResult& result);

 private:
  // Returns the stopping norm, with a solve for the Newton direction if the norm needs it; infinity
  // if the clamped Hessian is singular.
  double stopping_norm(const MinimizerProblem& problem, MinimizerResult& result);

  std::unique_ptr<LinearSolver> linear_;
  DirectionCheck check_;
  double next_gradient_ = 0;  // |gradient| below which the next solve is worth its cost
  bool begun_ = false;
  // Calls in this minimisation; the call that an observer is answered at.
  int asked_ = 0, next_asked_ = 0;
};

}  // namespace tack
