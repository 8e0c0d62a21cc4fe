#include "framework/scene/damping_config.hpp"

namespace tack {

void DampingConfig::fields(Fields& f) {
  f.number("stiffness", stiffness, units::time,
           "beta: times the stiffness of its energies at the start of each step; damps the rate of strain, fast vibrations most, and no "
           "translation or rotation. A vibration of angular frequency w loses beta w / 2 of critical").nonnegative();
  f.number("mass", mass, units::rate,
           "alpha: times its mass; damps every motion, falling too. A vibration of angular frequency w loses alpha / (2 w) of "
           "critical").nonnegative();
}

}  // namespace tack
