// Named selections, which motions, loads and probes refer to as `{type: tag, name: ...}`. The
// selected vertices become a group of the object, as if its mesh file had named them.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Adds the selections of each object, then those of the scene to every object in which they select
// a vertex and that has no group of that name. Throws InputError with the location in `root`.
void add_named_selections(const SceneConfig& scene, const Value& root, World& world);

}  // namespace tack
