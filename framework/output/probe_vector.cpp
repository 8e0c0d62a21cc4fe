#include "framework/output/probe.hpp"

namespace tack {

void VectorProbe::fields(Fields& f) {
  Probe::fields(f);
  f.optional_vector("direction", direction_, units::none,
                    "record the component along it; without it, three columns NAME_x, NAME_y, NAME_z");
  f.check("direction", [this]() -> std::string {
    return !direction_ || direction_->norm() > 0 ? "" : "must not be zero";
  });
}

std::vector<std::string> VectorProbe::columns() const {
  if (direction_) return {name_};
  return {name_ + "_x", name_ + "_y", name_ + "_z"};
}

std::vector<double> VectorProbe::sample(const World& world, const State& state) {
  const Vec3 v = value(world, state);
  if (direction_) return {v.dot(direction_->normalized())};
  return {v.x(), v.y(), v.z()};
}

}  // namespace tack
