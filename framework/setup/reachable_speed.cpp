#include "framework/setup/reachable_speed.hpp"

#include <algorithm>
#include <cmath>

#include "framework/body/extent.hpp"

namespace tack {

double reachable_speed(const SceneConfig& scene, const World& world) {
  Eigen::AlignedBox3d all;
  double speed = 0;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Eigen::AlignedBox3d box = extent_of(world.bodies[i], world.rest);
    all.extend(box);
    if (!world.bodies[i].movable) continue;
    speed = std::max(speed, scene.objects[i].velocity.norm() + scene.objects[i].spin.norm() * box.diagonal().norm() / 2);
  }
  if (!scene.gravity.isZero()) speed = std::hypot(speed, std::sqrt(2 * all.diagonal().dot(scene.gravity.cwiseAbs())));
  return speed;
}

}  // namespace tack
