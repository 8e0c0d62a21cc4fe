#include "framework/scene/external_loads.hpp"

namespace tack {

void set_loads(const SceneConfig& scene, World& world, double t, const VecX& x) {
  VecX weight = VecX::Zero(x.size()), force = VecX::Zero(x.size());
  for (Eigen::Index v = 0; v < world.mass.size(); ++v)
    vertex(weight, static_cast<int>(v)) = world.mass(v) * world.gravity;
  for (size_t i = 0; i < scene.objects.size(); ++i)
    for (const auto& load : scene.objects[i].loads)
      load->add_forces(world.bodies[i], world.rest, world.mass, t, force);
  world.gravity_term.set(std::move(weight), x);
  world.load_term.set(std::move(force), x);
}

}  // namespace tack
