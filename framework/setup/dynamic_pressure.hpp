// Stiffness of bodies and the pressures that they cause in contact.
#pragma once

#include <vector>

#include "framework/scene/scene_config.hpp"
#include "framework/setup/loading.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Rounds to two significant digits; 0 if the value is not positive.
double to_two_digits(double value);
// Returns the lowest Young's modulus of the object's energies [Pa]; 0: none has one.
double softest_young(const ObjectConfig& object);
// Returns density times speed^2 [Pa] per body of tetrahedra that may move faster than its elastic
// waves; 0 for other bodies. Rounding to two digits makes copies of a body equal in every
// orientation.
std::vector<double> dynamic_pressures(const SceneConfig& scene, const World& world,
                                      const std::vector<Loading>& loadings);

// Returns, per body, the pressure of its weight and largest loads in the run [Pa], to two digits; 0
// if the body is fixed or has no surface. The area is the surface's mean projection over all
// orientations (Cauchy: a quarter of the area of a closed surface).
std::vector<double> resting_pressures(const SceneConfig& scene, const World& world,
                                      double duration);

}  // namespace tack
