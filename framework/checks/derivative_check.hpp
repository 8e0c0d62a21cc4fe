// Checks the gradient and Hessian of every term of the potential against differences of its value,
// near the start of a scene.
#pragma once

#include <string>
#include <vector>

#include "framework/checks/difference_study.hpp"
#include "framework/core/phase_clock.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Relative errors that are let pass: a single entry that is off by some percent stays above.
inline constexpr double gradient_tolerance = 1e-6, hessian_tolerance = 1e-5;

struct DerivativeCheck {
  std::string term;  // name; the worst of several terms with it
  // gradient: differences of the value, relative to the root of the sum of squares of its parts;
  // hessian: differences of the gradient, relative to the sum of absolute values of a row.
  DifferenceStudy gradient, hessian;

  bool wrong() const { return gradient.wrong || hessian.wrong; }
  // Returns false where value and gradient are zero all around: nothing was checked.
  bool active() const { return gradient.scale > 0 || hessian.scale > 0; }
};

// Checks along fixed pseudo-random directions from two states near the start, within 3% and 0.1% of
// the local lengths (local_lengths.hpp), as in a step of size h [s]: touching surfaces slip.
std::vector<DerivativeCheck> check_derivatives(World& world, double h, PhaseClock& clock);

}  // namespace tack
