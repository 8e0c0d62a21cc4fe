// When what is written every `interval` [s] of simulated time is due again.
#pragma once

#include <cmath>

namespace tack {

// The first multiple of the interval after `time` [s]. `time` itself, so that every step is due, if the
// interval is 0 or far below the time step. In one go: intervals of 1e-300 s take no longer than others.
inline double next_due(double interval, double time, double step) {
  const double tolerance = 1e-9 * step;  // times are sums of steps, with their rounding
  if (!(interval > tolerance)) return time;
  return (std::floor((time + tolerance) / interval) + 1) * interval;
}

}  // namespace tack
