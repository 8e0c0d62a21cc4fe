// Test for objects inside solids at the start. Their surfaces need not meet, so that intersection
// tests do not find them.
#pragma once

#include <optional>

#include "framework/world/world.hpp"

namespace tack {

struct Containment {
  int body, vertex;  // the object inside, and a vertex of its surface inside (global)
  int solid, tet;    // the solid, and its tetrahedron that contains the vertex (from 0)
};

// Returns the first surface vertex in a tetrahedron of another object, for objects that may collide
// (ContactSystem::colliding) and can move relative to each other. The test is exact. Surfaces
// without tetrahedra count as hollow.
std::optional<Containment> find_containment(const World& world);

}  // namespace tack
