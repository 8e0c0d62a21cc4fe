// The state of a world, of which some objects have other elements now, and so other vertices
// inside.
#pragma once

#include "framework/remesh/new_elements.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Fields at vertices that are new are those of the points where they were; velocities of the
// object's free vertices are then changed by those of one rigid motion, such that neither its
// momentum nor its angular momentum changes. What is remembered between surfaces is so by their new
// numbers. Steps that look back at the one before have none.
State carried_state(const State& state, const World& was, const World& now,
                    const std::vector<NewElements>& exchanged);

struct StoredInObjects {
  double energy = 0;  // J
  VecX gradient;      // at all vertices (3n) [N]
};
StoredInObjects stored_in_objects(const World& world, const VecX& x);

// Changes the account of energy from what there was in the state before to what is in this one, and
// notes the difference as lost (world/remeshed_energy.hpp). `now`: with the unknowns of the step
// that follows. before: what objects stored then, its gradient carried like a field.
void book_remeshed_energy(const World& now, const StoredInObjects& before, State& state);

// A field at the vertices (3n) of the world before, at those of the world now.
VecX carried_field(const VecX& field, const World& was, const World& now,
                   const std::vector<NewElements>& exchanged);

// By how much the energy differs that was lost, by the last call of book_remeshed_energy [J].
double lost_by_remeshing(const State& state);

}  // namespace tack
