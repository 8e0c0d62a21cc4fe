// How stiff a body is, and with what it presses on what stops it.
#pragma once

#include <vector>

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// The lowest modulus of its energies [Pa]; 0: none has one.
double softest_young(const ObjectConfig& object);
// Of each body, density times speed^2 [Pa] if it is one of tets that may move faster than waves run in it; otherwise 0. To two digits, so that
// copies of one body are alike however they are turned.
std::vector<double> dynamic_pressures(const SceneConfig& scene, const World& world);

}  // namespace tack
