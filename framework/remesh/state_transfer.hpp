// Transfer of the state of a world after objects were remeshed: they have other elements, and other
// interior vertices.
#pragma once

#include "framework/remesh/new_elements.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns the state of the new world. Fields at new vertices are interpolated at their positions in
// the old mesh. The velocities of an object's free vertices then change by one rigid motion, so
// that its momentum and angular momentum are conserved. History between surfaces is renumbered.
// Integrators that use the previous step start without one.
State transfer_state(const State& state, const World& old_world, const World& new_world,
                     const std::vector<NewElements>& exchanged);

// Energy stored in objects.
struct StoredEnergy {
  double energy = 0;  // J
  VecX gradient;      // by all vertices (3n) [N]
};
StoredEnergy stored_energy_of_objects(const World& world, const VecX& x);

// Changes the energy account from the old state to the new one, and records the difference as a
// loss (world/remeshed_energy.hpp). new_world: with the unknowns of the next step. before: stored
// energy of the old state, its gradient transferred by transfer_field.
void record_energy_loss(const World& new_world, const StoredEnergy& before, State& state);

// Returns a field of the old world's vertices (3n) at those of the new world.
VecX transfer_field(const VecX& field, const World& old_world, const World& new_world,
                    const std::vector<NewElements>& exchanged);

// Returns the energy loss of the last call of record_energy_loss [J].
double energy_loss_of_remeshing(const State& state);

}  // namespace tack
