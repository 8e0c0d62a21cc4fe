// How far a run is from a measured curve, in one number each. With y the data, r what the run has there, and s the size of a deviation of one
// (|y| of the point itself, or the largest |y| of all points):
//   mean   average of |r - y| / s       bias   average of (r - y) / s
//   rms    its root mean square         worst  its largest
//   work, measured_work   int r dx and int y dx over the points, by the trapezoidal rule
#pragma once

#include <vector>

#include "framework/measured/measured_curve.hpp"

namespace tack {

enum class DeviationScale { point, peak };

struct Deviation {
  size_t compared = 0;  // points that the run has passed; nothing below counts others
  double mean = 0, bias = 0, rms = 0, worst = 0;
  size_t worst_at = 0;  // the point
  double work = 0, measured_work = 0;  // units of y times those of x
};

// `run`: as follow() gives it. Infinite where a deviation from nothing is asked for.
Deviation deviation_of(const MeasuredCurve& curve, const std::vector<double>& run, DeviationScale scale);

}  // namespace tack
