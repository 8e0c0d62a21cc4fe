// The curve of a function that can only be evaluated: knots where they are needed, slopes by differences.
#pragma once

#include <functional>

#include "geometry/curves/cubic_curve.hpp"

namespace tack {

struct AdaptiveCurve {
  static constexpr double tolerance = 1e-6;  // of the largest value
  static constexpr int most_knots = 4096;

  CubicCurve curve;
  double error = 0;              // the largest difference that was found, relative to the largest value
  double worst_from = 0, worst_to = 0;  // the two knots between which it was found
};

// Between first and last, beyond which the function is not looked at. Intervals are halved until the curve is within the tolerance of the
// function at three places of each; where that cannot be had (a jump), until they are a billionth of the whole or the knots are used up. Kinks end up
// between knots that are as near as they have to be. What the function throws goes through; it has to be finite.
AdaptiveCurve adaptive_curve(const std::function<double(double)>& function, double first, double last);

// Of the derivative of a function.
AdaptiveCurve adaptive_derivative(const std::function<double(double)>& function, double first, double last);

}  // namespace tack
