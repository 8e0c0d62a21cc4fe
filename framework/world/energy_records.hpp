// Energies of a state by name, for records.
#pragma once

#include <utility>
#include <vector>

#include "framework/core/records.hpp"

namespace tack {

struct World;
struct State;

// Returns, in this order [J]: kinetic; energies stored in objects by name, all bodies together;
// gravity, m g . (x_rest - x); published energies between objects: barrier, adhesion, bonds,
// friction, tangential_adhesion. Loads store no energy.
std::vector<NamedEnergy> energies_by_term(const World& world, const State& state);

// Returns the sum of the stored energies [J].
double stored_energy(const std::vector<NamedEnergy>& energies);

// Returns kinetic energy and gravity, m g . (x_rest - x), of free vertices [J].
std::pair<double, double> energies_of_free_vertices(const World& world, const State& state);
double weight_of_free_vertices(const World& world, const VecX& x);

}  // namespace tack
