// Default tolerances of solvers for experiments that state none, scaled with the scene, its steps
// and its contacts.
#pragma once

#include <memory>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns the experiment's solver with a default velocity tolerance if it has none. The world's
// bodies must exist. The force floor belongs to single unknowns and is computed when steps are
// taken (framework/stepping/force_groups.hpp).
std::unique_ptr<const Minimizer> solver_with_tolerances(const Experiment& experiment,
                                                        const World& world);

// Returns warnings about tolerances that do not fit the contact distance or the friction, one line
// each with the remedy.
std::vector<Warning> tolerance_warnings(const Experiment& experiment);

}  // namespace tack
