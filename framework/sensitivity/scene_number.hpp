// A number of a scene by its path, and the scene with another one in its place.
#pragma once

#include <memory>

#include "framework/experiment/built_experiment.hpp"

namespace tack {

// In SI. Throws InputError for a path that leads to no number of objects, contact, loads and the like: those of time, solver and output are
// none that probes could be differentiated by.
double scene_number(const BuiltExperiment& run, const std::string& key);

// The same experiment with that number at the path and no gradients. Throws InputError if it cannot have that.
LoadedExperiment scene_with(const BuiltExperiment& run, const std::string& key, double value);

// The same, built. Throws InputError if it has other meshes or unknowns then.
std::unique_ptr<BuiltExperiment> built_with(const BuiltExperiment& run, const std::string& key, double value);

}  // namespace tack
