// What a run has where a measured curve has its points: its samples (x, y) in the order of time, linear in between.
//
// Where the run's x never turns back, y is a function of x, and each point has the first passage of its x. Where it does (loading and unloading),
// both are followed by time: a point takes the first passage, not before that of the point before, in the direction in which the data go.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace tack {

// A place on the run's way: between two samples, this one and the next.
struct Passage {
  size_t sample = 0;
  double part = 0;  // of the way to the next one
  double of(std::span<const double> numbers) const { return part == 0 ? numbers[sample] : (1 - part) * numbers[sample] + part * numbers[sample + 1]; }
};

// Where the run passes each of `points`, the x of the data; nothing where it never gets there. `x`: of the run.
std::vector<std::optional<Passage>> passages(std::span<const double> points, std::span<const double> x);

// y of the run for each of `points`; NaN where the run never gets there. `x` and `y` are equally many.
std::vector<double> follow(std::span<const double> points, std::span<const double> x, std::span<const double> y);

}  // namespace tack
