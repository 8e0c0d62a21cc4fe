// Judges the convergence of methods whose own direction says nothing about the distance from the
// minimum (gradient methods, external minimisers), by the norm that Newton's method is judged by.
// Where that norm is of the Newton direction, one system is solved for it: at the start, and again
// when the gradient has fallen as far as the last verdict asked for.
#pragma once

#include <memory>

#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"
#include "solvers/minimizers/direction_check.hpp"

namespace tack {

class ConvergenceJudge {
 public:
  ConvergenceJudge();
  void begin();  // a new minimisation
  // Whether the objective's present point has converged; result.residual is the last verdict.
  bool converged(const MinimizerProblem& problem, MinimizerResult& result);
 private:
  // Solves for the Newton direction where that is the norm's; infinity where the clamped Hessian is
  // singular.
  double verdict(const MinimizerProblem& problem, MinimizerResult& result);

  std::unique_ptr<LinearSolver> linear_;
  DirectionCheck check_;
  double next_gradient_ = 0;  // |gradient| below which it is worth another look
  bool begun_ = false;
  // Calls of a minimisation, and the one that is to be answered for an observer.
  int asked_ = 0, next_asked_ = 0;
};

}  // namespace tack
