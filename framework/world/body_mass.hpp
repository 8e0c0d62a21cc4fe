// Masses of bodies, without those of scalar dofs: the twists of rods and the spins of particles
// have an inertia, but no weight.
#pragma once

#include <vector>

#include "framework/world/world.hpp"

namespace tack {

// Returns the mass of a body [kg]; 0 for one whose motion is prescribed throughout.
double body_mass(const World& world, int body);

// Returns the mass of each body [kg].
std::vector<double> body_masses(const World& world);

}  // namespace tack
