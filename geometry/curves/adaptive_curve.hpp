// Adaptive cubic interpolation of a function without derivatives: knots where they are needed,
// slopes by differences.
#pragma once

#include <functional>

#include "geometry/curves/cubic_curve.hpp"

namespace tack {

struct AdaptiveCurve {
  static constexpr double tolerance = 1e-6;  // of the largest value
  static constexpr int most_knots = 4096;

  CubicCurve curve;
  double error = 0;                     // largest difference found, over the largest value
  double worst_from = 0, worst_to = 0;  // knots of the interval where it was found
};

// Returns the curve of a function between first and last; the function is not evaluated outside.
// Intervals are bisected until the curve is within the tolerance of the function at three points of
// each; near a jump, until they are a billionth of last - first or the knots are used up. Kinks lie
// between two close knots. Values must be finite; exceptions of the function propagate.
AdaptiveCurve adaptive_curve(const std::function<double(double)>& function, double first,
                             double last);

// Returns the curve of the derivative of a function.
AdaptiveCurve adaptive_derivative(const std::function<double(double)>& function, double first,
                                  double last);

}  // namespace tack
