// Derivatives of residuals: those that runs give themselves, else differences of runs.
#pragma once

#include <functional>

#include "framework/calibrate/fitted_number.hpp"
#include "framework/calibrate/point_evaluation.hpp"
#include "geometry/types.hpp"

namespace tack {

// d residuals / d u, at a point.
struct Derivatives {
  Eigen::MatrixXd of_residuals;  // a row for each measured point, a column for each number
  std::string problem;           // why there are none; "" if there are
  std::vector<bool> by_runs;     // of each number: the runs gave its column themselves
  std::vector<std::string> why;  // of each number whose column is of differences, why; "" if it is as asked for
  double missed = 0;             // of what residuals change by from here to `compared` points nearby, the part that runs' own derivatives do not tell
  int compared = 0;
  std::vector<double> missed_of;  // of each number: the same of its column, by the slopes that fit those points best; empty if they lie too badly for that
};

using EvaluateAll = std::function<std::vector<PointEvaluation>(const std::vector<Point>&)>;

// At the point u, `middle` being its evaluation. Of numbers of which that has no derivatives, central differences of `step` around it; to one side at a
// bound, and where the run at the other failed.
Derivatives derivatives_at(const std::vector<FittedNumber>& numbers, const std::vector<double>& u, double step, const PointEvaluation& middle,
                           const EvaluateAll& evaluate);

// Holds them against other points whose numbers are all within `reach` (in u): curves that break off have steps, which the runs' own derivatives do not know.
void compare_with(const std::vector<const PointEvaluation*>& others, const std::vector<FittedNumber>& numbers, const PointEvaluation& middle, double reach,
                  Derivatives& d);

}  // namespace tack
