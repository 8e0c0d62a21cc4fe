// State of a simulation whose bodies are moved between two steps.
#pragma once

#include "framework/core/state.hpp"

namespace tack {

struct World;

// Returns the state with other positions x [m] and velocities v [m/s] of the meshes' vertices (3
// per vertex). Frames of affine bodies and all dependent vertices are computed from these. The
// state starts again, as at the start of a run:
// - History of the last step is dropped: positions, velocities, step size, error of adaptive
//   steps, accelerations. `a` is empty: the time loop computes accelerations from the forces and
//   resets lagged friction, contact sides and weights, and the stepper's history.
// - The energy balance restarts; dissipation so far stays counted.
// - Kept: time, number of steps, prescribed motions, and the history of bodies, bonds and
//   interactions (plastic strain, damage, twists of rods).
// Throws InputError for positions that dependent vertices cannot have.
State moved_state(const World& world, const State& before, const VecX& x, const VecX& v);

}  // namespace tack
