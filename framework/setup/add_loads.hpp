// Adds the loads of a scene to its world.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Adds the loads of all objects. Throws InputError, before any result is written, for a load that
// finds nothing to act on. root: the parsed file.
void add_loads(const SceneConfig& scene, const Value& root, World& world);

// Records a term of the world that is a load, so that its work is reported. Throws InputError for a
// name that is in use.
void register_following_load(FollowingLoad& load, World& world);

}  // namespace tack
