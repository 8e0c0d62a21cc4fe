// The state of a simulation whose bodies are put elsewhere between two steps.
#pragma once

#include "framework/core/state.hpp"

namespace tack {

struct World;

// Returns the state with other positions x and velocities v of the meshes' vertices (3 per vertex)
// [m, m/s]. Frames of affine bodies and all vertices that follow others are found from these. The
// state begins anew, as that of a run's start:
// - nothing is left of the step before: positions, velocities, its size, the error of adaptive
//   steps, accelerations. `a` is empty: the time loop then finds accelerations from the forces, and
//   forgets lagged friction, contact's sides and shares, and what the stepper has kept;
// - the balance of energy opens again; what was dissipated so far stays counted.
// Time, number of steps, prescribed motions and what bodies, bonds and interactions remember
// (plastic strain, damage, twists of rods) stay.
// Throws InputError for positions of vertices that have to follow others and would not.
State moved_state(const World& world, const State& before, const VecX& x, const VecX& v);

}  // namespace tack
