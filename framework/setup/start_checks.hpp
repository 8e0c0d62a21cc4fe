// Whether a world may start as it is.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Throws InputError, with the remedy, where objects intersect, touch, are closer than their offsets, or one is inside of another. root: the parsed file.
void check_start(const SceneConfig& scene, const Value& root, World& world);

}  // namespace tack
