// Checks of the initial configuration.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Throws InputError, with the remedy, if objects intersect, touch, are closer than their offsets,
// one is inside of another, or a state of another run has an infinite energy here. root: the parsed
// file.
void check_start(const SceneConfig& scene, const Value& root, World& world);

}  // namespace tack
