// Finite differences of every term of the potential, next to the start of a scene.
#pragma once

#include <string>
#include <vector>

#include "framework/core/phase_clock.hpp"
#include "framework/scene/world.hpp"

namespace tack {

struct DerivativeCheck {
  std::string term;           // the worst of those of this name
  double gradient_error = 0;  // of the value's differences, relative
  double hessian_error = 0;   // of the gradient's differences, relative to the largest component

  // Far beyond what differences leave, kinks of a law included.
  bool wrong() const { return gradient_error > 1e-3 || hessian_error > 0.1; }
};

// Central differences along a few fixed pseudo-random directions, where every free vertex has moved a
// little from the start, as in a step of size h [s]: contact sets do not change on the way, and surfaces
// that touch slip.
std::vector<DerivativeCheck> check_derivatives(World& world, double h, PhaseClock& clock);

}  // namespace tack
