// Newton's method on the equations of a path (path_equations.hpp):
//     [ K    g_t ] [ dq ]     [ g     ]
//     [ c_q  c_t ] [ dt ] = - [ c - L ],
// with the exact Hessian K, by block elimination: two solves with one factor of K. Steps are
// truncated to feasible ones. There is no line search, because an unstable equilibrium is no
// minimum; the step size controller halves a step that does not converge.
#pragma once

#include "framework/stepping/convergence.hpp"
#include "framework/stepping/feasible_steps.hpp"
#include "solvers/path_following/indefinite_factor.hpp"
#include "solvers/path_following/path_equations.hpp"

namespace tack {

class PathNewton {
 public:
  PathNewton(const StepperContext& context, const StepObservers& observers);

  void begin_unknowns() { convergence_.begin_unknowns(); }
  void begin_step(const Step& step) {
    steps_.reset();
    convergence_.begin_step(step.potential, step.h, false);
  }

  struct Result {
    MinimizerResult work;
    PathPoint point;
    int negative_pivots = 0;
    Convergence::ForceResidual force_residual;
    bool converged() const { return work.status == MinimizerStatus::converged; }
  };
  // Solves from `guess`, a feasible point. length: L, of the step by the constraint. Throws
  // FreeBody.
  Result solve(PathEquations& equations, StepPotential& potential, PathConstraint constraint,
               double length, PathPoint guess);
  // Returns the point that a step of this length along the tangent at the start of the step
  // reaches, truncated to a feasible step. Its load time grows. Returns the start if the tangent is
  // undefined.
  PathPoint along_tangent(PathEquations& equations, StepPotential& potential,
                          PathConstraint constraint, double length);
  // Returns the largest feasible part of the step from one point to another.
  PathPoint truncated(const PathEquations& equations, const PathPoint& from, const PathPoint& to);
  // See FeasibleSteps.
  std::string blocker() const { return steps_.blocker(); }

 private:
  PhaseClock& clock_;
  const StepObservers& observers_;
  Convergence convergence_;
  FeasibleSteps steps_;
  IndefiniteFactor factor_;
};

}  // namespace tack
