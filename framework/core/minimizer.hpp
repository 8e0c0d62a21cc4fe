// The contract of every minimiser: from a feasible q, a local minimiser of the objective, without
// ever leaving the feasible set, judged by the program's own stopping norm. Failing to converge is a
// returned status, not an exception.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "framework/config/registry.hpp"
#include "framework/core/objective.hpp"
#include "framework/core/phase_clock.hpp"

namespace tack {

enum class MinimizerStatus {
  converged,          // the stopping norm is below the tolerance
  iteration_limit,    // max_iterations used up
  line_search_failed, // no step along a descent direction decreases the objective
  blocked,            // the feasible step shrank to nothing
  factorization_failed,
  not_finite,         // value or gradient is not a number
  interrupted,
  time_limit,         // OutOfTime was thrown (deadline.hpp)
};
std::string_view to_string(MinimizerStatus status);

// One problem: what to minimise, where from, and when to stop.
struct MinimizerProblem {
  Objective& objective;
  // The largest t in (0, 1] such that q + s p is feasible for s in [0, t].
  std::function<double(const VecX& q, const VecX& p)> feasible_step;
  // The stopping norm given the last search direction p and the gradient; converged when below 1.
  std::function<double(const VecX& p, const VecX& gradient)> stopping_norm;
  PhaseClock& clock;
  // Whether that norm is of p, which then must be the Newton direction: methods whose own direction is
  // something else ask solvers/minimizers/convergence_judge.hpp.
  bool norm_of_direction = true;
  // If given, every minimiser tells it of every iteration: its number, the stopping norm as far as it is known,
  // the objective's value and the seconds since the minimisation began.
  using Observer = std::function<void(int iteration, double residual, double value, double seconds)>;
  Observer observer = {};
  // Of a direction that leaves the residual r = -g - H p of its Newton system: how much the stopping norm of
  // the exact direction may exceed that of p. If it is not given, directions are believed.
  std::function<double(const VecX& r)> direction_error = {};
  // The largest force that nothing balances, in units of what is tolerated; if given, it must be below 1
  // where the minimisation ends.
  std::function<double(const VecX& gradient)> imbalance = {};
  // If given, p <- a step from q that agrees with it to first order and turns stiff bodies without straining them, where
  // straining one would cost more than `loss`, in units of the objective. False, and p as it was, if there is none.
  std::function<bool(const VecX& q, VecX& p, double loss)> bend = {};
  // Whether the observer is to be told the stopping norm also where it costs a linear solve that the method itself does without: at the first
  // twenty iterations, and then at every tenth part more of them. Not for what is timed.
  bool true_residuals = false;
};

struct MinimizerResult {
  MinimizerStatus status = MinimizerStatus::converged;
  int iterations = 0;
  int linear_solves = 0;
  long linear_iterations = 0;  // of linear solvers that iterate
  int line_search_evaluations = 0;  // values in search of a step length, or of a foreign minimiser
  double residual = 0;  // the last stopping norm, in units of the tolerance

  // Adds the work of an earlier minimisation of the same step.
  void add_work(const MinimizerResult& other) {
    iterations += other.iterations;
    linear_solves += other.linear_solves;
    linear_iterations += other.linear_iterations;
    line_search_evaluations += other.line_search_evaluations;
  }
};

// Whether forces balance at the objective's present point, as far as the problem asks; result.residual tells by
// how much they do not.
bool balanced(const MinimizerProblem& problem, MinimizerResult& result);

// When a minimisation has converged.
enum class Stopping {
  velocity,      // |p|_inf / h below a tolerance [m/s], p the Newton direction (the paper)
  force,         // |gradient|_inf below a part of the largest force of any stencil
  acceleration,  // |M^-1 gradient|_inf below a tolerance [m/s^2]
};

class Term;

class Minimizer : public Component {
 public:
  static constexpr const char* kind_name = "minimizer";
  static constexpr const char* kind_doc = "Minimises the incremental potential of one step.";

  void fields(Fields& f) override;
  Stopping stopping() const { return stopping_; }
  double velocity_tolerance() const { return tolerance_.value_or(0.01); }     // m/s
  double force_tolerance() const { return force_tolerance_; }                // relative
  double balance_tolerance() const { return balance_tolerance_.value_or(0.01); }  // relative
  std::optional<double> force_floor() const { return force_floor_; }         // N
  double acceleration_tolerance() const { return acceleration_tolerance_; }  // m/s^2

  std::optional<double> time_limit() const { return time_limit_; }  // s of wall time
  bool checks_iterates() const { return check_iterates_; }

  // What a scene that does not say gets: framework/experiment/tolerances.hpp.
  bool tolerance_given() const { return tolerance_.has_value(); }
  bool balance_given() const { return balance_tolerance_.has_value(); }
  void set_velocity_tolerance(double tolerance) { tolerance_ = tolerance; }
  void set_force_floor(double floor) { force_floor_ = floor; }

  // Returns a minimiser with the same settings and no history of earlier minimisations: for
  // problems beside those of the steps.
  virtual std::unique_ptr<Minimizer> fresh() const;
  // What solves linear systems and why, once it is known; "" for methods without.
  virtual std::string linear_solver() const { return {}; }
  // Throws InputError for a potential of these terms that it cannot minimise. Asked when a scene is loaded.
  virtual void admit(const std::vector<const Term*>& /*terms*/, int /*unknowns*/) const {}

  // q: in, the feasible start; out, the last feasible iterate. Every call of the problem may throw
  // OutOfTime, which need not be caught: that loses the counts of the work alone.
  virtual MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) = 0;

 protected:
  int max_iterations_ = 500;

 private:
  Stopping stopping_ = Stopping::velocity;
  std::optional<double> tolerance_;    // m/s
  std::optional<double> force_floor_;  // N
  std::optional<double> balance_tolerance_;  // relative
  double force_tolerance_ = 1e-4;
  double acceleration_tolerance_ = 1;  // m/s^2
  std::optional<double> time_limit_;   // s
  bool check_iterates_ = false;
};

}  // namespace tack
