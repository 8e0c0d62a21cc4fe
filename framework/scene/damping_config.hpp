// Damping of an object, as in the scene file.
#pragma once

#include "framework/config/field.hpp"

namespace tack {

struct DampingConfig {
  double stiffness = 0;  // beta [s]
  double mass = 0;       // alpha [1/s]
  void fields(Fields& f);
};

}  // namespace tack
