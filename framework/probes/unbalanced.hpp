// Forces that balance the others: reactions of prescribed vertices and forces of joints.
#pragma once

#include "framework/core/state.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns, per vertex, inertia minus all forces (3n) [N], including forces that replace those of
// terms. After a step by the trapezoidal rule (Newmark's) it is the mean over the step, which
// balances the momentum: elastic forces of both ends and the change of velocity. Dynamic terms
// enter with the force of the end.
VecX unbalanced_forces(const World& world, const State& state);

}  // namespace tack
