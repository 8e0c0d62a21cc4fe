// Feasible step sizes: how far the unknowns may move by all step filters. Remembers the last trial
// for messages.
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
  // Collects the filters that have something to watch in the world. check: sees every state from
  // which a step is requested; may be null.
  FeasibleSteps(World& world, PhaseClock& clock, IterateCheck* check = nullptr);

  // The largest t in (0, 1] such that x + s p (3n) is feasible for s in [0, t]. Throws OutOfTime.
  double largest(const VecX& x, const VecX& p);
  // Returns largest() for a step that a minimiser requests, and notifies the observer.
  double largest_tried(const VecX& x, const VecX& p);
  // q and p: unknowns of the potential, whose configuration supplies all other vertices.
  double largest_tried(const StepPotential& potential, const VecX& q, const VecX& p);
  // Forgets the last trial.
  void reset() { x_.resize(0); }
  // Returns "; the last step was ..." with the primitive that truncated the last trial, or "".
  std::string blocker() const;

  using Observer = std::function<void(const VecX& x, const VecX& p, double feasible)>;
  void observe(Observer observer) { observer_ = std::move(observer); }

 private:
  World& world_;
  PhaseClock& clock_;
  IterateCheck* check_;
  std::vector<std::unique_ptr<StepFilter>> filters_;
  VecX x_, p_;  // tried last (3n); x_ is empty before
  Observer observer_;
};

}  // namespace tack
