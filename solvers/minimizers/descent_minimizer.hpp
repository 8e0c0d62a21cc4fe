// The loop of all descent methods: direction, stopping norm, step. A new method implements
// direction(). What is made of the direction is the matter of step policies
// (solvers/steps/step_policy.hpp).
#pragma once

#include <memory>

#include "framework/core/minimizer.hpp"
#include "solvers/line_search/line_search.hpp"
#include "solvers/minimizers/stagnation.hpp"
#include "solvers/minimizers/convergence_judge.hpp"
#include "solvers/steps/step_policy.hpp"

namespace tack {

/// Base of descent methods: minimize() is the loop, direction() the method.
class DescentMinimizer : public Minimizer {
 public:
  void fields(Fields& f) override;
  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) final;

 protected:
  using Step = MadeStep;

  /// Begins a minimisation; the objective is at its first point.
  virtual void begin(const MinimizerProblem&, MinimizerResult&) {}
  /// p <- a descent direction at the objective's present point. Any status but `converged` ends
  /// the minimisation. The loop checks that the gradient is finite: before the call unless
  /// newton_like(), and after it.
  virtual MinimizerStatus direction(const MinimizerProblem& problem, VecX& p,
                                    MinimizerResult& result) = 0;
  /// Notifies the method of a step; the objective is at the new point.
  virtual void stepped(const MinimizerProblem&, const Step&) {}
  /// Returns true if the length of p measures the distance to the minimum, as for a Newton
  /// direction.
  virtual bool newton_like() const { return false; }
  /// Returns true if p is a Newton direction but for the smallest shift of a Hessian that is
  /// semi-definite (free rigid motions), which round-off may make indefinite.
  virtual bool nearly_newton() const { return false; }
  /// Returns the stopping norm of p, a newton_like() direction, and of the error of p against the
  /// exact direction.
  virtual double newton_norm(const MinimizerProblem& problem, VecX& p, MinimizerResult&) {
    return problem.stopping_norm(p, problem.objective.gradient());
  }
  /// Returns true if p may be replaced by another direction where no step along it decreases the
  /// objective; false if none is left.
  virtual bool restart(const MinimizerProblem&) { return false; }

 private:
  MinimizerResult descend(const MinimizerProblem& problem, VecX& q, MinimizerResult& result);
  MinimizerStatus advance(const StepContext& context, const VecX& p, VecX& q);
  bool at_equilibrium(const MinimizerProblem& problem, const VecX& p,
                      MinimizerResult& result) const;

  std::unique_ptr<LineSearch> line_search_ = Registry<LineSearch>::make("backtracking");
  StepPolicies step_ = default_step_policies();
  // Force residual too large after the last step, which was below the tolerance.
  bool unbalanced_ = false;
  ConvergenceJudge judge_;
  Stagnation stagnation_;
};

}  // namespace tack
