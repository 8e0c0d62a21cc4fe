#include "framework/setup/adhesion_lengths.hpp"

#include <algorithm>
#include <cmath>

#include "framework/setup/dynamic_pressure.hpp"

namespace tack {

double process_zone(double young, double work, double peak) { return young * work / (peak * peak); }

double bending_length(double stiffness, double work, double peak) { return std::pow(2 * stiffness * work / (peak * peak), 0.25); }

double bending_stiffness(const ObjectConfig& object, const Body& body) {
  double least = 0;
  for (const auto& energy : object.energies)
    if (const double own = energy->bending_stiffness(body); own > 0) least = least > 0 ? std::min(least, own) : own;
  return least;
}

PairStiffness pair_stiffness(const SceneConfig& scene, const World& world, const std::array<int, 2>& pair) {
  const auto lower = [](double& least, double own) {
    if (own > 0) least = least > 0 ? std::min(least, own) : own;
  };
  PairStiffness softer;
  for (const int i : pair) {
    const double bending = bending_stiffness(scene.objects[i], world.bodies[i]);
    lower(softer.bending, bending);
    if (bending == 0) lower(softer.young, softest_young(scene.objects[i]));
  }
  return softer;
}

}  // namespace tack
