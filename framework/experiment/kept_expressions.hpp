// The resolved scene of a run with sensitivities: scene parameters keep their effect.
#pragma once

#include "framework/experiment/experiment.hpp"

namespace tack {

// Returns the experiment with every key, as to_value(fields_of(experiment)). With
// `output.gradients`, expressions and formulas of scene parameters in `root`, the scene as written,
// stand in place of their numbers: otherwise no number of the file would follow a parameter, and
// its sensitivities would be zero in every run of that file.
Value resolved_scene(const Value& root, const Experiment& experiment);

}  // namespace tack
