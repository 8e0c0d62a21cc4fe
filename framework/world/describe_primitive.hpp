#pragma once

#include <string>
#include <vector>

#include "framework/world/world.hpp"

namespace tack {

// Returns "edge (3, 4) of 'plate'" for one to four global vertices of one object.
std::string describe_primitive(const World& world, const std::vector<int>& vertices);

}  // namespace tack
