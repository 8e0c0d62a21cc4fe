// Warnings about friction of round things that do not turn. Friction of rods and particles acts on
// their centre lines and centres unless they roll (setup/spins.hpp): they stick on a slope where a
// cylinder or a ball rolls. A warning names the object, the surface that it can rub on, the
// coefficient of friction and the remedy. A warning is due for
//   - a rod of circular section with no vertex of its connected component always fixed or attached,
//   - a particle that is not always fixed or attached,
// with every object that is in contact with it with mu > 0.
#pragma once

#include <vector>

#include "framework/core/warning.hpp"

namespace tack {

struct SceneConfig;
struct World;

// One line for each kind (rods, particles), partner and coefficient, with the first object of it.
std::vector<Warning> round_friction_warnings(const SceneConfig& scene, const World& world);

}  // namespace tack
