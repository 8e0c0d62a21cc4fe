// Triangles of one object that do not adhere to each other.
#pragma once

#include "framework/contact/contact_set.hpp"

namespace tack {

// Returns whether two triangles of one object share a vertex, or have vertices or edges that are
// neighbours at rest (rest_neighbours.hpp) within range [m].
bool neighbours_at_rest(const ContactSurface& surface, int a, int b, double range);

}  // namespace tack
