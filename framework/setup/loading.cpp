#include "framework/setup/loading.hpp"

#include "framework/setup/reachable_speed.hpp"

namespace tack {

Loading loading_of(const SceneConfig& scene, const World& world) {
  double mass = 0;
  for (int v = 0; v < static_cast<int>(world.mass.size()); ++v)
    if (world.script.ever_free(v)) mass += world.weighing_mass(v);
  return {reachable_speed(scene, world), mass * scene.gravity.norm()};
}

}  // namespace tack
