#include "framework/world/load_terms.hpp"

#include "framework/protocol/drives.hpp"
#include "framework/world/load.hpp"

namespace tack {

void GravityTerm::set_up(const VecX& mass, const Vec3& gravity) {
  VecX weight(3 * mass.size());
  for (Eigen::Index v = 0; v < mass.size(); ++v) vertex(weight, static_cast<int>(v)) = mass(v) * gravity;
  set_force(std::move(weight));
}

VecX LoadTerm::forces_at(double t, Eigen::Index size) const {
  VecX force = VecX::Zero(size);
  for (const Acting& a : loads_) {
    if (!a.factor) {
      a.load->add_forces(*a.body, *a.rest, *a.mass, t, force);
      continue;
    }
    VecX whole = VecX::Zero(size);
    a.load->add_forces(*a.body, *a.rest, *a.mass, t, whole);
    force += a.factor->at(t) * whole;
  }
  return force;
}

std::vector<double> LoadTerm::abrupt_times() const {
  std::vector<double> all;
  for (const Acting& a : loads_) {
    const std::vector<double> own = a.load->corners();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

void LoadTerm::begin_step(const StepStart& start) {
  if (!loads_.empty()) set_force(forces_at(start.time + start.h, start.x.size()));
  set_reference(start.x);
}

}  // namespace tack
