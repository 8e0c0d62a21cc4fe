// The loop of all descent methods: direction, stopping norm, feasible step, line search. A new
// method implements direction().
#pragma once

#include <memory>

#include "framework/core/minimizer.hpp"
#include "solvers/line_search/line_search.hpp"
#include "solvers/minimizers/stagnation.hpp"
#include "solvers/minimizers/convergence_judge.hpp"

namespace tack {

/// Base of descent methods: minimize() is the loop, direction() the method.
class DescentMinimizer : public Minimizer {
 public:
  void fields(Fields& f) override;
  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) final;

 protected:
  /// An accepted step: q <- q + length * p.
  struct Step {
    const VecX& p;
    double length;    ///< [1]
    double feasible;  ///< largest length that the step filters allow [1]
    int evaluations;  ///< evaluations of the line search; 1: the first length was accepted
    double slope;     ///< p . gradient at the start
    double decrease;  ///< decrease of the objective
  };

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
  MinimizerStatus advance(const MinimizerProblem& problem, const VecX& p, VecX& q,
                          MinimizerResult& result);
  bool at_equilibrium(const MinimizerProblem& problem, const VecX& p,
                      MinimizerResult& result) const;
  bool advance_with_retraction(const MinimizerProblem& problem, const VecX& p, VecX& q,
                               MinimizerResult& result);
  void conjugate(const MinimizerProblem& problem, const VecX& q, VecX& p, bool within);
  void extend(const MinimizerProblem& problem, const VecX& p, double first_slope, double before,
              VecX& q, MinimizerResult& result);

  std::unique_ptr<LineSearch> line_search_ = Registry<LineSearch>::make("backtracking");
  VecX gradient_before_, q_before_;  // at the last iteration of this minimisation
  // Hessians of this minimisation are too stiff, since some step, and no step was truncated
  bool too_stiff_ = false;
  bool truncated_ = false;  // the last step was truncated
  // Force residual too large after the last step, which was below the tolerance.
  bool unbalanced_ = false;
  bool accelerated_ = false;    // this step is conjugate to the last one, and extrapolated
  double feasible_length_ = 0;  // feasible length of this step, in units of its direction
  ConvergenceJudge judge_;
  Stagnation stagnation_;
};

}  // namespace tack
