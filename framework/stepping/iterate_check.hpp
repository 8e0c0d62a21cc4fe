// solver.check_iterates: every state that a solve passes through is checked exactly, independently of the
// step filters. A minimiser cannot move without asking how far it may go from where it is, so looking there
// misses no accepted state of any minimiser, walk or guess, whatever it does in between.
#pragma once

#include <string>

#include "framework/core/phase_clock.hpp"
#include "framework/world/world.hpp"

namespace tack {

class IterateCheck {
 public:
  IterateCheck(const World& world, PhaseClock& clock) : world_(world), clock_(clock) {}

  // What the states that follow belong to: "the minimisation" of step 3.
  void begin(int step, const std::string& stage);
  // Throws SimulationError, with step, stage, iteration and what is wrong, unless x (3n) is feasible. The
  // first state of a stage is iteration 0; the same one again is no new iteration.
  void at(const VecX& x);

 private:
  const World& world_;
  PhaseClock& clock_;
  int step_ = 0, iteration_ = -1;
  std::string stage_;
  VecX last_;
};

// "tet (1, 2, 3, 4) of 'ball' is inverted", "edge (1, 2) of 'ball' meets triangle (0, 1, 2) of 'plate'"; ""
// if x (3n) is feasible. By exact predicates.
std::string describe_infeasibility(const World& world, const VecX& x);

}  // namespace tack
