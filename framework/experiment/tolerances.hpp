// What a solve may leave, where the experiment does not say: it scales with the scene, its steps and its contacts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/core/phase_clock.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/world/world.hpp"

namespace tack {

// The experiment's solver with the tolerance and the force floor that it lacks. The world's bodies, masses and
// elements must be there.
std::unique_ptr<const Minimizer> settled_solver(const Experiment& experiment, const World& world, PhaseClock& clock);

// Tolerances that do not fit the contact distance or the friction, one line each with the remedy.
std::vector<std::string> doubtful_tolerances(const Experiment& experiment, const World& world);

}  // namespace tack
