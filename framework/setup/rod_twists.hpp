// The twist of edges as unknowns of a world (framework/rod/rod_frames.hpp), and what motions make of it.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Appends a vertex for the twist of each edge of body `index` on which one of its energies twists, with the frames of its rest
// shape. Throws InputError for an edge along the section's normal.
void add_twists(const ObjectConfig& object, int index, World& world);

// Of a motion that holds these vertices whole: it holds the twist of each edge of which it holds both ends too, and turns the
// edge's frame as it turns space around it.
void hold_twists(const Motion& motion, const std::vector<int>& vertices, const std::string& name, int index, World& world);

}  // namespace tack
