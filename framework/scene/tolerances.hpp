// What a solve may leave, where the scene does not say: it scales with the scene, its steps and its contacts.
#pragma once

#include <string>
#include <vector>

#include "framework/core/phase_clock.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/scene/world.hpp"

namespace tack {

// Gives the scene's solver the tolerance and the force floor that it lacks. The world's bodies, masses and
// elements must be there.
void settle_tolerances(const SceneConfig& scene, const World& world, PhaseClock& clock);

// Tolerances that do not fit the contact distance or the friction, one line each with the remedy.
std::vector<std::string> doubtful_tolerances(const SceneConfig& scene, const World& world);

}  // namespace tack
