// What something else has to exert on vertices: what holds them, what joins them.
#pragma once

#include "framework/core/state.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Of every vertex (3n), its inertia and minus all that acts on it, forces in the place of terms
// included [N]. Of a step by the trapezoidal rule (Newmark's) it is the mean over the step, what
// balances its momentum: elastic forces of both ends and the change of velocity; dynamic terms act
// with the force of the end.
VecX unbalanced_forces(const World& world, const State& state);

}  // namespace tack
