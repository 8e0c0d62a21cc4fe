// Debonding check of a step: whether it resolves the adhesion of a body that lets go.
//
// The force of the end of a step acts during all of it. A step that takes an adhesion from before
// its peak to beyond its range therefore takes no work from the bodies, and one that stops a body
// in front of the peak takes all that it has. Of the vertices of a body that adhere at the start of
// the step, at most share_max may belong to stencils that take up more than debonding_work_max of
// their work past the peak (core/debonding.hpp): in the step itself, or in its motion with the
// velocities of the start. A crack that advances by some elements per step passes.
#pragma once

#include "framework/world/world.hpp"

namespace tack {

class DebondingCheck {
 public:
  // Largest fraction of the adhering vertices of a body.
  static constexpr double share_max = 0.5;

  explicit DebondingCheck(const World& world) : world_(world) {}

  // Returns the first body that debonds too far in a motion from x to y (3n); -1: none. All
  // participants of the step must be at x.
  int find(const VecX& x, const VecX& y) const;

 private:
  const World& world_;
};

}  // namespace tack
