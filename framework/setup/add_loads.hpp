// The loads of a scene, in its world.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// All that objects have. Every load finds what it acts on, or this is told before anything is written (InputError). root: the parsed file.
void add_loads(const SceneConfig& scene, const Value& root, World& world);

// Of a term of the world that is such a load: all are asked for their work. Throws InputError for a name that another one has.
void note_following_load(FollowingLoad& load, World& world);

}  // namespace tack
