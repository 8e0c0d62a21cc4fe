// Hulls: prescribed objects that are triangle meshes and enclose a volume, such as walls, floors
// and obstacles from files. Objects outside of a hull interact with its outer side only, as with
// that of a solid. Shells stay two-sided sheets, as do rooms: hulls around other objects.
#pragma once

#include <vector>

#include "framework/world/world.hpp"

namespace tack {

// Returns, per body, whether it is a hull.
std::vector<char> find_hulls(const World& world);

}  // namespace tack
