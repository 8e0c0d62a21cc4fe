// Values of a run at the points of a measured curve. The samples (x, y) of the run are in the order
// of time and linearly interpolated.
//
// The samples may belong to several windows of time, between which nothing is interpolated.
//
// Two cases:
// - the run's x is monotonic in each window: each point takes the first passage of its x
// - the run's x turns back (loading and unloading): both curves are followed in time, and a point
//   takes the first passage in the direction of the data, not before the passage of the previous
//   point
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace tack {

// A position on the path of a run, between the samples `sample` and `sample` + 1.
struct Passage {
  size_t sample = 0;
  double fraction = 0;  // of the segment
  // Interpolates a column of the run.
  double value_of(std::span<const double> numbers) const {
    return fraction == 0 ? numbers[sample]
                         : (1 - fraction) * numbers[sample] + fraction * numbers[sample + 1];
  }
};

// Returns where the run passes each of `points`, the x of the data; nothing for points that it
// never reaches. `x`: of the run. starts: first samples of the windows, ascending; none: one.
std::vector<std::optional<Passage>> passages(std::span<const double> points,
                                             std::span<const double> x,
                                             std::span<const size_t> starts = {});

// Returns y of the run at each of `points`; NaN for points that it never reaches. `x` and `y` have
// equal length.
std::vector<double> follow(std::span<const double> points, std::span<const double> x,
                           std::span<const double> y, std::span<const size_t> starts = {});

}  // namespace tack
