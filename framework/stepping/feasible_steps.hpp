// Feasible step sizes: the largest step that all step filters allow. The last requested step is
// stored for messages.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/step_filter.hpp"
#include "framework/stepping/iterate_check.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

class FeasibleSteps {
 public:
  // Collects the filters that apply to the world. check: is given every state from which a step is
  // requested; may be null.
  FeasibleSteps(World& world, PhaseClock& clock, IterateCheck* check = nullptr);

  // Returns the largest t in (0, 1] such that x + s p (3n) is feasible for s in [0, t]. Throws
  // OutOfTime.
  double largest(const VecX& x, const VecX& p);
  // Returns largest() for a step that a minimiser requests, and notifies the observer.
  double largest_requested(const VecX& x, const VecX& p);
  // Overload for q and p over the unknowns of the potential, whose configuration supplies all other
  // vertices.
  double largest_requested(const StepPotential& potential, const VecX& q, const VecX& p);
  // Clears the last requested step.
  void reset() { x_.resize(0); }
  // Returns "; the last step was ..." with the primitive that truncated the last requested step, or
  // "".
  std::string blocker() const;

  using Observer = std::function<void(const VecX& x, const VecX& p, double feasible)>;
  void observe(Observer observer) { observer_ = std::move(observer); }

 private:
  World& world_;
  PhaseClock& clock_;
  IterateCheck* check_;
  std::vector<std::unique_ptr<StepFilter>> filters_;
  VecX x_, p_;  // last requested step (3n); x_ is empty before the first one
  Observer observer_;
};

}  // namespace tack
