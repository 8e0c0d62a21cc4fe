// What a solve may leave, where the experiment does not say: it scales with the scene, its steps and its contacts.
#pragma once

#include <string>
#include <vector>

#include "framework/core/phase_clock.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/scene/world.hpp"

namespace tack {

// Gives the experiment's solver the tolerance and the force floor that it lacks. The world's bodies, masses and
// elements must be there.
void settle_tolerances(const Experiment& experiment, const World& world, PhaseClock& clock);

// Tolerances that do not fit the contact distance or the friction, one line each with the remedy.
std::vector<std::string> doubtful_tolerances(const Experiment& experiment, const World& world);

}  // namespace tack
