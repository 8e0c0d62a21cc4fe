// Access to a scene parameter by its path, and scenes with another value of it.
#pragma once

#include <memory>

#include "framework/experiment/built_experiment.hpp"

namespace tack {

// Returns the parameter in SI. Throws InputError for a path that names no number, and for settings
// of time, solver and output, to which probes have no sensitivities.
double scene_parameter(const BuiltExperiment& run, const std::string& key);

// Returns the experiment with `value` at the path and without gradients. Throws InputError if the
// value is invalid.
LoadedExperiment scene_with(const BuiltExperiment& run, const std::string& key, double value);

// Builds that experiment. Throws InputError if its meshes or unknowns differ from the run's.
std::unique_ptr<BuiltExperiment> built_with(const BuiltExperiment& run, const std::string& key,
                                            double value);

}  // namespace tack
