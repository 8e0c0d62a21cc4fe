// A minimisation as external gradient methods see it: a smooth function f(z) of scaled unknowns,
// which the method may evaluate anywhere, and a chain of accepted points, which this class keeps. A
// trial point is usable only if the step filters pass the linear path to it from the last accepted
// point, so that accepted points are always joined by feasible paths.
//
// Scaled unknowns, around the point c at which a round starts, with D the diagonal of the Hessian
// there:
//     q = c + rho D^-1/2 z,    f = (E(q) - E(c)) / rho^2,    rho = |D^-1/2 grad E(c)|_inf,
// so that slopes and curvatures of f are about one. Where a difference of energies is below
// rounding error, f continues from the last accepted point by the mean of both gradients.
#pragma once

#include <exception>
#include <functional>
#include <optional>

#include "framework/core/minimizer.hpp"
#include "solvers/minimizers/convergence_judge.hpp"
#include "solvers/minimizers/iteration_notifier.hpp"

namespace tack {

/// One minimisation for an external method.
class GuardedProblem {
 public:
  // Moves q to every accepted point and fills the counts of `result`.
  GuardedProblem(const MinimizerProblem& problem, ConvergenceJudge& judge, int max_iterations,
                 VecX& q, MinimizerResult& result);

  /// Rescales around the last accepted point. Returns false if nothing is left to do; see over().
  bool begin_round();
  int size() const { return static_cast<int>(q_.size()); }

  enum class Trial { usable, blocked, not_finite };
  /// Evaluates f and its gradient at z (both scaled). `blocked`: the path to z is infeasible, or
  /// far too long.
  Trial evaluate(const double* z, double& f, double* gradient);
  /// Returns, after an unusable trial, value and gradient of a quadratic penalty above the last
  /// accepted point, for methods that need values everywhere.
  void evaluate_penalty(const double* z, double& f, double* gradient);

  double accepted_value() const { return accepted_f_; }
  /// Makes z the accepted point and counts one iteration. Returns false, with nothing changed,
  /// unless f is lower there and the path is feasible.
  bool accept(const double* z);

  /// Returns true if no further trial is wanted: convergence, budgets, Ctrl-C, or an exception of
  /// the objective.
  bool over() const { return status_.has_value() || failure_; }
  MinimizerStatus status() const { return *status_; }
  void stop(MinimizerStatus status) { status_ = status; }
  /// Stores an exception: external code need not pass exceptions on. rethrow() throws it.
  void fail(std::exception_ptr failure) { failure_ = failure; }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  /// Returns true after too many consecutive failed trials: the method should restart.
  bool makes_no_progress() const;
  /// fruitless: the last round had no accepted point; reason: the status for that.
  bool fruitless() const { return result_.iterations == iterations_before_; }
  MinimizerStatus reason() const;

 private:
  // Tests convergence and budgets at the accepted point, where the objective is.
  void test_accepted_point();
  VecX unscaled(const double* z) const;
  double relative_value(const VecX& q, double value, const VecX& gradient) const;

  const MinimizerProblem& problem_;
  ConvergenceJudge& judge_;
  const IterationNotifier notify_;
  const int max_iterations_;
  VecX& q_;
  MinimizerResult& result_;

  VecX centre_, scale_;     // c [m]; rho D^-1/2 [m]
  double rho_squared_ = 1;  // kg m^2
  double longest_ = 0;      // largest displacement of a coordinate in a trial [m]
  double accepted_value_ = 0, accepted_noise_ = 0, accepted_f_ = 0;
  VecX accepted_gradient_;

  VecX trial_;                    // the last evaluated point
  double feasible_fraction_ = 0;  // feasible fraction of the path to it
  double trial_f_ = 0;
  bool trial_usable_ = false;

  int trials_left_ = 0;
  // Counts within the round; the last one, in a row.
  int iterations_before_ = 0, tried_ = 0, blocked_ = 0, idle_ = 0;
  std::optional<MinimizerStatus> status_;
  std::exception_ptr failure_;
};

/// Calls round(guarded) until nothing is left to do, or two rounds in a row accept no point. In a
/// round an external method runs from z = 0 until it ends or is stopped.
MinimizerResult minimize_in_rounds(const MinimizerProblem& problem, ConvergenceJudge& judge,
                                   int max_iterations, VecX& q,
                                   const std::function<void(GuardedProblem&)>& round);

}  // namespace tack
