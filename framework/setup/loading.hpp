// What bodies may be pressed with, as far as a scene tells before it runs.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

struct Loading {
  double speed = 0;   // that something may reach (reachable_speed.hpp) [m/s]
  double weight = 0;  // of all that is ever free [N]
};

Loading loading_of(const SceneConfig& scene, const World& world);

}  // namespace tack
