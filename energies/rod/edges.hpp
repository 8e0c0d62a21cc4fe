// Base of energies of edges.
#pragma once

#include "framework/body/body.hpp"

namespace tack {

// Its section; throws InputError naming the body and the energy if it has no edges, or none.
const RodSection& section_of(const Body& body, std::string_view energy);

double edge_length(const Edge& edge, const VecX& rest);  // m

// Adds half of each edge's mass to its ends [kg].
void add_edge_mass(const Body& body, const VecX& rest, double density, VecX& mass);

}  // namespace tack
