// What is doubtful of a scene before it is run, a line each: of laws, meshes, elements, their sizes and tolerances.
#pragma once

#include <string>
#include <vector>

#include "framework/experiment/experiment.hpp"
#include "framework/world/world.hpp"

namespace tack {

// The contact system is left at the start.
std::vector<std::string> scene_warnings(const Experiment& experiment, World& world);

}  // namespace tack
