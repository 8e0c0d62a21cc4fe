#include "framework/experiment/drawn_scene.hpp"

namespace tack {

std::optional<double> drawn_radius(const ObjectConfig& object) {
  if (object.rod) return object.rod->section().contact_width() / 2;
  if (object.particle) return object.particle->radius;
  return std::nullopt;
}

Vec3 up_direction(const Experiment& experiment) {
  return experiment.gravity.norm() > 0 ? Vec3(-experiment.gravity.normalized()) : Vec3::UnitY();
}

}  // namespace tack
