// Next time of output with a fixed interval of simulated time [s].
#pragma once

#include <cmath>

namespace tack {

// Returns the first multiple of the interval after `time` [s]; `time` itself (every step is due) if
// the interval is 0 or far below the time step. Constant cost for any interval.
inline double next_due(double interval, double time, double step) {
  const double tolerance = 1e-9 * step;  // times are sums of steps, with rounding errors
  if (!(interval > tolerance)) return time;
  return (std::floor((time + tolerance) / interval) + 1) * interval;
}

// Returns the first time after `time` that is due if nothing is before `from` [s], which is due
// itself.
inline double next_due_from(double from, double interval, double time, double step) {
  return time < from - 1e-9 * step ? from : next_due(interval, time, step);
}

}  // namespace tack
