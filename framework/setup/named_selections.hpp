// Selections with a name, which motions, loads and probes refer to as `{type: tag, name: ...}`: the vertices that one
// chooses become a group of the object, as if its mesh file had named them.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Adds those of each object, then those of the scene to every object of which they choose a vertex and that has
// no group of that name. Throws InputError with the place in `root`.
void add_named_selections(const SceneConfig& scene, const Value& root, World& world);

}  // namespace tack
