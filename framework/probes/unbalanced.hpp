// What something else has to exert on vertices: what holds them, what joins them.
#pragma once

#include "framework/core/state.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Of every vertex (3n), its inertia and minus all that acts on it, forces in the place of terms included [N].
VecX unbalanced_forces(const World& world, const State& state);

}  // namespace tack
