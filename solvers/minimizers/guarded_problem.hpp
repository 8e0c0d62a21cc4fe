// A minimisation as foreign gradient methods see it: a smooth function f(z) of scaled unknowns, which
// they may ask for anywhere, and a chain of accepted points, which is ours. A trial point counts only if
// the step filters pass the straight way to it from the last accepted point whole; so whatever a method
// asks for, the accepted points are joined by feasible ways.
//
// Scaled unknowns, around the point c where a round starts, with D the diagonal of the Hessian there:
//     q = c + rho D^-1/2 z,    f = (E(q) - E(c)) / rho^2,    rho = |D^-1/2 grad E(c)|_inf,
// so that f has slopes and curvatures of about one. Where a difference of energies drowns in rounding
// error, f continues from the last accepted point by the mean of both gradients instead.
#pragma once

#include <exception>
#include <functional>
#include <optional>

#include "framework/core/minimizer.hpp"
#include "solvers/minimizers/convergence_judge.hpp"
#include "solvers/minimizers/tell_iteration.hpp"

namespace tack {

class GuardedProblem {
 public:
  // Moves q with every accepted point, and fills the result's counts.
  GuardedProblem(const MinimizerProblem& problem, ConvergenceJudge& judge, int max_iterations, VecX& q,
                 MinimizerResult& result);

  // Scales anew around the last accepted point. False if nothing is left to do; see over().
  bool begin_round();
  int size() const { return static_cast<int>(q_.size()); }

  enum class Trial { usable, blocked, not_finite };
  // f and its gradient at z (both scaled). `blocked`: the way to z is not feasible, or far too long.
  Trial evaluate(const double* z, double& f, double* gradient);
  // After a trial that is not usable: value and gradient of a bowl above the last accepted point, for
  // methods that cannot do without.
  void evaluate_wall(const double* z, double& f, double* gradient);

  double accepted_value() const { return accepted_f_; }
  // Makes z the accepted point. False, with nothing changed, unless f is lower there and the way is free.
  // One iteration.
  bool accept(const double* z);

  // Why no further trial is wanted: convergence, budgets, Ctrl-C, or an exception of the objective.
  bool over() const { return status_.has_value() || failure_; }
  MinimizerStatus status() const { return *status_; }
  void stop(MinimizerStatus status) { status_ = status; }
  // Foreign code is not asked to pass exceptions on.
  void fail(std::exception_ptr failure) { failure_ = failure; }
  void rethrow() const { if (failure_) std::rethrow_exception(failure_); }

  // So many trials in a row led nowhere that the method had better start anew.
  bool gets_nowhere() const;
  // Whether the last round brought no accepted point; the status that fits.
  bool fruitless() const { return result_.iterations == iterations_before_; }
  MinimizerStatus reason() const;

 private:
  void look();  // convergence and budgets at the accepted point, where the objective is
  VecX unscaled(const double* z) const;
  double relative_value(const VecX& q, double value, const VecX& gradient) const;

  const MinimizerProblem& problem_;
  ConvergenceJudge& judge_;
  const TellIteration tell_;
  const int max_iterations_;
  VecX& q_;
  MinimizerResult& result_;

  VecX centre_, scale_;      // c [m]; rho D^-1/2 [m]
  double rho_squared_ = 1;   // kg m^2
  double longest_ = 0;       // a coordinate's way that a trial may ask for [m]
  double accepted_value_ = 0, accepted_noise_ = 0, accepted_f_ = 0;
  VecX accepted_gradient_;

  VecX trial_;        // the last evaluated point
  double reach_ = 0;  // part of the way to it that is free
  double trial_f_ = 0;
  bool trial_usable_ = false;

  int trials_left_ = 0;
  int iterations_before_ = 0, tried_ = 0, blocked_ = 0, idle_ = 0;  // in the round; the last, in a row
  std::optional<MinimizerStatus> status_;
  std::exception_ptr failure_;
};

// Calls round(guarded), in which a foreign method runs from z = 0 until it ends by itself or is told to,
// until nothing is left to do, or two rounds in a row bring nothing.
MinimizerResult minimize_in_rounds(const MinimizerProblem& problem, ConvergenceJudge& judge, int max_iterations,
                                   VecX& q, const std::function<void(GuardedProblem&)>& round);

}  // namespace tack
