// Derivatives of residuals: from the runs themselves where they give them, else finite differences
// between runs.
#pragma once

#include <functional>

#include "framework/calibrate/fitted_number.hpp"
#include "framework/calibrate/point_evaluation.hpp"
#include "geometry/types.hpp"

namespace tack {

// d residuals / d u at a point.
struct Derivatives {
  Eigen::MatrixXd of_residuals;  // a row for each measured point, a column for each number
  std::string problem;           // reason why there are no derivatives; ""
  std::vector<bool> by_runs;     // per number: the runs gave its column
  // Per number with a column of finite differences: the reason; "" if they were asked for.
  std::vector<std::string> why;
  // Relative error of the runs' own derivatives: the part of the change of residuals to `compared`
  // nearby points that they do not predict.
  double missed = 0;
  int compared = 0;
  // Per number: relative error of its column, against slopes fitted to those points; empty if the
  // points do not determine slopes.
  std::vector<double> missed_of;
};

using EvaluateAll = std::function<std::vector<PointEvaluation>(const std::vector<Point>&)>;

// Computes the derivatives at the point u, whose evaluation is `middle`. Numbers without
// derivatives in `middle` get central differences of width `step`; one-sided at a bound, and where
// one of the two runs failed.
Derivatives derivatives_at(const std::vector<FittedNumber>& numbers, const std::vector<double>& u,
                           double step, const PointEvaluation& middle, const EvaluateAll& evaluate);

// Compares the derivatives with the evaluations whose numbers are all within `reach` (in u), and
// fills in `missed`. Curves with sudden breaks have steps, which the runs' own derivatives do not
// see.
void compare_with(const std::vector<const PointEvaluation*>& others,
                  const std::vector<FittedNumber>& numbers, const PointEvaluation& middle,
                  double reach, Derivatives& d);

}  // namespace tack
