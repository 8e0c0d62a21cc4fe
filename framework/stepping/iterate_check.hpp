// Exact check of all iterates of a solve, independent of the step filters (solver.check_iterates).
// A minimiser must request a feasible step size before it moves. Checking the state at each request
// covers every accepted state of every minimiser and initial guess.
#pragma once

#include <string>

#include "framework/core/phase_clock.hpp"
#include "framework/world/world.hpp"

namespace tack {

// End of the message about a state that is not feasible.
inline constexpr const char* found_by_iterate_check = "(found by solver.check_iterates)";

class IterateCheck {
 public:
  IterateCheck(const World& world, PhaseClock& clock) : world_(world), clock_(clock) {}

  // Sets the step and the name of the stage of the following states, e.g. "the minimisation".
  void begin(int step, const std::string& stage);
  // Throws SimulationError with step, stage, iteration and the fault unless x (3n) is feasible. The
  // first state of a stage is iteration 0; repeating a state is no new iteration.
  void check(const VecX& x);

 private:
  const World& world_;
  PhaseClock& clock_;
  int step_ = 0, iteration_ = -1;
  std::string stage_;
  VecX last_;
};

// Returns "" if x (3n) is feasible by exact predicates, or the fault: "tet (1, 2, 3, 4) of 'ball'
// is inverted", "edge (1, 2) of 'ball' meets triangle (0, 1, 2) of 'plate'".
std::string describe_infeasibility(const World& world, const VecX& x);

}  // namespace tack
