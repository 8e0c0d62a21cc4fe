// The state of a world, of which some objects have other elements now, and so other vertices inside.
#pragma once

#include "framework/remesh/new_elements.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Fields at vertices that are new are those of the points where they were; velocities of the object's free vertices are then changed by those of one
// rigid motion, such that neither its momentum nor its angular momentum changes. What is remembered between surfaces is so by their
// new numbers. Steps that look back at the one before have none.
State carried_state(const State& state, const World& was, const World& now, const std::vector<NewElements>& exchanged);

// Changes the account of energy from what was stored in the state before to what is in this one, and notes the difference as lost (world/remeshed_energy.hpp).
// `now`: with the unknowns of the step that follows. stored_before: gradient of what objects stored, at the state before, carried like one (3n) [N].
void book_remeshed_energy(const World& now, const VecX& stored_before, State& state);

// The gradient of what is stored in objects, at all vertices (3n) [N].
VecX stored_gradient(const World& world, const VecX& x);

// A field at the vertices (3n) of the world before, at those of the world now.
VecX carried_field(const VecX& field, const World& was, const World& now, const std::vector<NewElements>& exchanged);

// By how much the energy differs that was lost, by the last call of book_remeshed_energy [J].
double lost_by_remeshing(const State& state);

}  // namespace tack
