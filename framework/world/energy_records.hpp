// The energies of a state by name, for records.
#pragma once

#include <utility>
#include <vector>

#include "framework/core/records.hpp"

namespace tack {

struct World;
struct State;

// kinetic, then those that are stored in objects, by name (all bodies together), gravity (m g . (x_rest - x)), and what there is between
// objects, as published: barrier, adhesion, bonds, friction, tangential_adhesion [J]. Loads store no energy: not listed.
std::vector<NamedEnergy> energies_by_term(const World& world, const State& state);

// The sum of those that are stored [J].
double stored_energy(const std::vector<NamedEnergy>& energies);

// Kinetic energy and gravity (as above), of free vertices [J].
std::pair<double, double> energies_of_free_vertices(const World& world, const State& state);
double weight_of_free_vertices(const World& world, const VecX& x);

}  // namespace tack
