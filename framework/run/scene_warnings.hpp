// Warnings about a scene before it runs, one line each: laws, meshes, elements, their sizes and
// tolerances.
#pragma once

#include <vector>

#include "framework/core/warning.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns the warnings. Leaves the contact system at the start configuration.
std::vector<Warning> scene_warnings(const Experiment& experiment, World& world);

}  // namespace tack
