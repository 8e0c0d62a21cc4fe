// Default tolerances of solves, where the experiment states none. They scale with the scene, its
// steps and its contacts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/experiment/experiment.hpp"
#include "framework/world/world.hpp"

namespace tack {

// The experiment's solver with the velocity tolerance that it lacks. The world's bodies must be
// there. The force floor belongs to single unknowns and is found when steps are taken
// (framework/stepping/force_groups.hpp).
std::unique_ptr<const Minimizer> settled_solver(const Experiment& experiment, const World& world);

// Tolerances that do not fit the contact distance or the friction, one line each with the remedy.
std::vector<std::string> doubtful_tolerances(const Experiment& experiment, const World& world);

}  // namespace tack
