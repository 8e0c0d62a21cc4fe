// How fast what moves may become.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Of the velocities that objects start with and a fall over the whole scene [m/s].
double reachable_speed(const SceneConfig& scene, const World& world);

}  // namespace tack
