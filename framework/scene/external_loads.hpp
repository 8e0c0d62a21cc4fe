// The linear terms of a world: weight and loads.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/scene/world.hpp"

namespace tack {

// Makes them those of time t [s]; their energies are counted from the configuration x.
void set_loads(const SceneConfig& scene, World& world, double t, const VecX& x);

}  // namespace tack
