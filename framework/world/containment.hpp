// Is something inside a solid at the start? Their surfaces need not meet for that, so that looking for
// intersections does not find it.
#pragma once

#include <optional>

#include "framework/world/world.hpp"

namespace tack {

struct Containment {
  int body, vertex;     // what is inside, and a vertex of its surface that shows it (global)
  int around, tet;      // the solid, and which of its tets the vertex is in (from 0)
};

// The first surface vertex that lies in a tet of another object, of those that may touch (ContactSystem::colliding)
// and can move against each other. Exact. Surfaces without tets are hollow: nothing is inside them.
std::optional<Containment> find_containment(const World& world);

}  // namespace tack
