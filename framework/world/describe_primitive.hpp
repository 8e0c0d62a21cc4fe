#pragma once

#include <string>
#include <vector>

#include "framework/world/world.hpp"

namespace tack {

// "edge (3, 4) of 'plate'", of its global vertices: one to four of one object.
std::string describe_primitive(const World& world, const std::vector<int>& vertices);

}  // namespace tack
