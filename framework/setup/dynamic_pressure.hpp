// How stiff a body is, and with what it presses on what stops it.
#pragma once

#include <vector>

#include "framework/scene/scene_config.hpp"
#include "framework/setup/loading.hpp"
#include "framework/world/world.hpp"

namespace tack {

double to_two_digits(double value);  // 0 where it is not positive
// The lowest modulus of its energies [Pa]; 0: none has one.
double softest_young(const ObjectConfig& object);
// Of each body, density times speed^2 [Pa] if it is one of tets that may move faster than waves run
// in it; otherwise 0. To two digits, so that copies of one body are alike however they are turned.
std::vector<double> dynamic_pressures(const SceneConfig& scene, const World& world,
                                      const std::vector<Loading>& loadings);


// Of each body, the pressure of its weight and of its largest loads in the run on the mean shadow
// of its surface (a quarter of the area of a closed one, Cauchy), to two digits, however it is
// turned [Pa]; 0: held, or without a surface.
std::vector<double> resting_pressures(const SceneConfig& scene, const World& world,
                                      double duration);

}  // namespace tack
