// Deviation of a run from a measured curve. With y the data, r the run at the same points, and s
// the scale of a relative deviation (|y| of the point, or the largest |y| of all points):
//   mean   average of |r - y| / s
//   bias   average of (r - y) / s
//   rms    root mean square of |r - y| / s
//   worst  largest |r - y| / s
//   work, measured_work   int r dx and int y dx over the points, by the trapezoidal rule
#pragma once

#include <vector>

#include "framework/measured/measured_curve.hpp"

namespace tack {

enum class DeviationScale { point, peak };

struct Deviation {
  size_t compared = 0;  // points that the run has passed; the others count nowhere
  double mean = 0, bias = 0, rms = 0, worst = 0;
  size_t worst_at = 0;                 // index of the point
  double work = 0, measured_work = 0;  // unit of y times unit of x
};

// Computes the deviation. `run`: as returned by follow(). Infinite for a deviation relative to
// zero.
Deviation deviation_of(const MeasuredCurve& curve, const std::vector<double>& run,
                       DeviationScale scale);

}  // namespace tack
