// What something else has to exert on vertices: what holds them, what joins them.
#pragma once

#include "framework/core/state.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns the inertia of every vertex minus all forces on it (3n) [N]. Forces that replace those of
// terms are included. After a step by the trapezoidal rule (Newmark's) it is the mean over the
// step, which balances the momentum: elastic forces of both ends and the change of velocity.
// Dynamic terms act with the force of the end.
VecX unbalanced_forces(const World& world, const State& state);

}  // namespace tack
