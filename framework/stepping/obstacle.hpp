// What a scripted vertex was stopped by, for messages.
#pragma once

#include <string>

#include "framework/scene/world.hpp"

namespace tack {

// "the script drives 'plate' into 'block': vertex 3 of 'plate' is still 0.002 m short of its place".
// x: 3n; v: the vertex (global); distance: to its place [m].
std::string describe_obstacle(const World& world, const VecX& x, int v, double distance);

}  // namespace tack
