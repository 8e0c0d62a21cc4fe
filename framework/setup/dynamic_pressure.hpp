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
// Returns density times speed^2 of each body [Pa] that consists of tets and may move faster than
// waves run in it; 0 for any other. Two digits make copies of a body equal in every orientation.
std::vector<double> dynamic_pressures(const SceneConfig& scene, const World& world,
                                      const std::vector<Loading>& loadings);


// Returns, per body, the pressure of its weight and of its largest loads in the run [Pa], to two
// digits; 0 if the body is fixed or has no surface. The area is the mean shadow of the surface over
// all orientations (Cauchy: a quarter of the area of a closed surface).
std::vector<double> resting_pressures(const SceneConfig& scene, const World& world,
                                      double duration);

}  // namespace tack
