#include "framework/scene/damping_config.hpp"

namespace tack {

void DampingConfig::fields(Fields& f) {
  f.number("stiffness", stiffness, units::time,
           "beta: factor of the stiffness of its energies at the start of each step; damps strain rates, fast "
           "vibrations most, but no rigid motion. Damping ratio of a vibration of angular frequency w: beta w / 2").nonnegative();
  f.number("mass", mass, units::rate,
           "alpha: factor of its mass; damps every motion, falling too. Damping ratio of a vibration of angular "
           "frequency w: alpha / (2 w)").nonnegative();
}

}  // namespace tack
