// A minimisation for external gradient methods: a smooth function f(z) of scaled unknowns,
// evaluated anywhere, and a chain of accepted points. A trial point is usable only if the step
// filters pass the linear trajectory to it from the last accepted point; so accepted points are
// joined by feasible trajectories, whatever points a method asks for.
//
// Scaled unknowns, around the point c where a round starts, with D the diagonal of the Hessian
// there:
//     q = c + rho D^-1/2 z,    f = (E(q) - E(c)) / rho^2,    rho = |D^-1/2 grad E(c)|_inf,
// so that f has slopes and curvatures of about one. Where rounding errors exceed a difference of
// energies, f continues from the last accepted point by the mean of both gradients instead.
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
  GuardedProblem(const MinimizerProblem& problem, ConvergenceJudge& judge, int max_iterations,
                 VecX& q, MinimizerResult& result);

  // Scales around the last accepted point. Returns false if the minimisation is over().
  bool begin_round();
  int size() const { return static_cast<int>(q_.size()); }

  enum class Trial { usable, blocked, not_finite };
  // Sets f and its gradient at z (both scaled). `blocked`: the trajectory to z is not feasible, or
  // far too long.
  Trial evaluate(const double* z, double& f, double* gradient);
  // Sets value and gradient of a convex penalty above the last accepted point, after a trial that
  // is not usable, for methods that need finite values.
  void evaluate_wall(const double* z, double& f, double* gradient);

  double accepted_value() const { return accepted_f_; }
  // Accepts z: one iteration. Returns false, and changes nothing, unless f is lower there and the
  // trajectory is free.
  bool accept(const double* z);

  // Returns whether the minimisation is over: converged, out of budget, interrupted, or the
  // objective has thrown.
  bool over() const { return status_.has_value() || failure_; }
  MinimizerStatus status() const { return *status_; }
  void stop(MinimizerStatus status) { status_ = status; }
  // Stores an exception of the objective: external code does not propagate exceptions.
  void fail(std::exception_ptr failure) { failure_ = failure; }
  void rethrow() const { if (failure_) std::rethrow_exception(failure_); }

  // Returns whether too many trials in a row were not usable, so that the method should restart.
  bool gets_nowhere() const;
  // Returns whether the last round had no accepted point; reason(): its status.
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
  double longest_ = 0;       // largest displacement of a coordinate in a trial [m]
  double accepted_value_ = 0, accepted_noise_ = 0, accepted_f_ = 0;
  VecX accepted_gradient_;

  VecX trial_;        // the last evaluated point
  double reach_ = 0;  // free fraction of the trajectory to it
  double trial_f_ = 0;
  bool trial_usable_ = false;

  int trials_left_ = 0;
  // In the round; the last, in a row.
  int iterations_before_ = 0, tried_ = 0, blocked_ = 0, idle_ = 0;
  std::optional<MinimizerStatus> status_;
  std::exception_ptr failure_;
};

// Calls round(guarded), in which an external method runs from z = 0 until it ends or the problem is
// over, until the minimisation is over or two rounds in a row accept no point.
MinimizerResult minimize_in_rounds(const MinimizerProblem& problem, ConvergenceJudge& judge,
                                   int max_iterations, VecX& q,
                                   const std::function<void(GuardedProblem&)>& round);

}  // namespace tack
