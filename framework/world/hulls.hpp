// Held objects that are meshes of triangles and enclose a volume: walls, floors, obstacles from files. What lies outside of one
// sees its outer side alone, as of an object of tets. A shell stays a sheet with two sides, and so does a room: a hull around
// other objects.
#pragma once

#include <vector>

#include "framework/world/world.hpp"

namespace tack {

// Of each body.
std::vector<char> find_hulls(const World& world);

}  // namespace tack
