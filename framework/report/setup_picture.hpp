// A picture of a scene before it is run, drawn as `tack render` draws runs.
#pragma once

#include <filesystem>

#include "framework/experiment/load_experiment.hpp"

namespace tack {

// Draws the initial state to `output` (.png). Throws InputError for a scene that cannot be built, a
// name of another ending, and missing node or browser.
void draw_setup(LoadedExperiment loaded, const std::filesystem::path& output);

}  // namespace tack
