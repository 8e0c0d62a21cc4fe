// Whether gradient and Hessian of every term of the potential are those of its value, next to the start
// of a scene.
#pragma once

#include <string>
#include <vector>

#include "framework/checks/difference_study.hpp"
#include "framework/core/phase_clock.hpp"
#include "framework/world/world.hpp"

namespace tack {

struct DerivativeCheck {
  std::string term;  // the worst of those of this name
  // The value's differences against the gradient, relative to the root of the sum of the squares of its
  // parts; the gradient's against the Hessian, relative to the sum of the absolute parts of a row.
  DifferenceStudy gradient, hessian;

  bool wrong() const { return gradient.wrong || hessian.wrong; }
  // False where value and gradient are zero all around: nothing was checked.
  bool in_play() const { return gradient.scale > 0 || hessian.scale > 0; }
};

// Along fixed pseudo-random directions from two states close to the start, within 3% and 0.1% of the local
// lengths (local_lengths.hpp), as in a step of size h [s]: surfaces that touch slip.
std::vector<DerivativeCheck> check_derivatives(World& world, double h, PhaseClock& clock);

}  // namespace tack
