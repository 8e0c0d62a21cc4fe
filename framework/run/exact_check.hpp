// Exact check of positions, independent of the collision detection of the solver.
#pragma once

#include "framework/world/world.hpp"

namespace tack {

/// Returns the number of edges that meet triangles at x (3n) [m], up to 100, plus 1 if a
/// tetrahedron is inverted. Exact predicates decide. Throws SimulationError if a coordinate is not
/// finite.
int intersections_at(const World& world, const VecX& x);

}  // namespace tack
