// Twists of edges as unknowns of a world (framework/rod/rod_frames.hpp), and their prescribed
// motion.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Appends a vertex for the twist of each edge of body `index` on which an energy acts by twist,
// with the frames of its rest shape. Throws InputError for an edge along the section's normal.
void add_twists(const ObjectConfig& object, int index, World& world);

// Prescribes the twist of each edge with both ends in `vertices`, which `motion` prescribes in all
// directions: the frame of the edge rotates with the motion.
void prescribe_twists(const Motion& motion, const std::vector<int>& vertices,
                      const std::string& name, int index, World& world);

}  // namespace tack
