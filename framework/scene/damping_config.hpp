// Damping of an object, as the scene gives it.
#pragma once

#include "framework/config/field.hpp"

namespace tack {

struct DampingConfig {
  double stiffness = 0;  // beta [s]
  double mass = 0;       // alpha [1/s]
  void fields(Fields& f);
};

}  // namespace tack
