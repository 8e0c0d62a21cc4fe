// Step policies: what a descent method makes of its direction. A minimiser has a list of them
// (`solver.step`). In every iteration the loop (descent_minimizer.hpp) calls, in their order,
//   direct   each: may change the direction
//   advance  one after the other, until one makes the step
//   after    each: may go on from where the step ended
// so that a new policy is one file and leaves all others in force. At least one policy of a list
// makes every step.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "framework/core/minimizer.hpp"
#include "solvers/line_search/line_search.hpp"

namespace tack {

/// One iteration of a descent method, as a policy sees it.
struct StepContext {
  const MinimizerProblem& problem;
  LineSearch& line_search;
  MinimizerResult& result;  // counts of the work, to be added to
  bool newton_like;         // the length of the direction measures the distance to the minimum
  // The direction may be replaced by a better one, and the step extrapolated: false for the last
  // steps of a minimisation, which end where Newton's method ends.
  bool accelerate;
  bool within;        // the direction is below the tolerance of the stopping norm, and must stay so
  double length_max;  // of a step along the direction, in its units, so that it stays so
};

/// A step that was made: q <- q + length * p, or a path that begins like that.
struct MadeStep {
  const VecX& p;
  double length;    ///< [1]
  double feasible;  ///< largest length that the step filters allow [1]
  int evaluations;  ///< evaluations of the line search; 1: the first length was accepted
  double slope;     ///< p . gradient at the start
  double before;    ///< the objective at the start
  double decrease;  ///< of the objective
  bool straight;    ///< along p, and no other path
};

/// Base of step policies.
class StepPolicy : public Component {
 public:
  static constexpr const char* kind_name = "step_policy";
  static constexpr const char* kind_doc =
      "Makes the step of a descent method from its direction. A list of them acts in its order.";

  /// Begins a minimisation; the objective is at its first point.
  virtual void begin(const MinimizerProblem&) {}
  /// May replace p, a descent direction at q, where the objective is.
  virtual void direct(const StepContext&, const VecX& /*q*/, VecX& /*p*/) {}
  /// Makes the step: moves q, and the objective to it, and sets `made`, unless what it did is no
  /// step along p. Returns `converged` for success, another status if no step is possible, and
  /// nothing, with q and the objective as they were, to leave the step to the next policy.
  virtual std::optional<MinimizerStatus> advance(const StepContext&, const VecX& /*p*/, VecX& /*q*/,
                                                 std::optional<MadeStep>& /*made*/) {
    return std::nullopt;
  }
  /// Called after a step, also if another policy made it; may move q on, and the objective with it.
  /// made: null if q was moved otherwise than along a direction.
  virtual void after(const StepContext&, const MadeStep* /*made*/, VecX& /*q*/) {}
  /// Returns true if advance() never leaves the step to another policy.
  virtual bool makes_every_step() const { return false; }
};

using StepPolicies = std::vector<std::unique_ptr<StepPolicy>>;

/// Returns the policies of a minimiser whose scene names none.
StepPolicies default_step_policies();

}  // namespace tack
