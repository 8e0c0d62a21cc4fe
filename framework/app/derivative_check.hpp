// Finite differences of the whole potential at the start of a scene.
#pragma once

#include "framework/scene/world.hpp"

namespace tack {

struct DerivativeCheck {
  double gradient_error = 0;  // relative to the largest component
  double hessian_error = 0;
};

// Central differences along a few fixed pseudo-random directions.
DerivativeCheck check_derivatives(World& world, PhaseClock& clock);

}  // namespace tack
