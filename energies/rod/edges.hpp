// Section, length and mass of edges, for all energies of edges.
#pragma once

#include "framework/body/body.hpp"

namespace tack {

// Returns the section of the edges. Throws InputError with body and energy if there are no edges or
// no section.
const RodSection& section_of(const Body& body, std::string_view energy);

double edge_length(const Edge& edge, const VecX& rest);  // m

// Adds half of each edge's mass to its ends [kg].
void add_edge_mass(const Body& body, const VecX& rest, double density, VecX& mass);

}  // namespace tack
