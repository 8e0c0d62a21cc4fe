// Derivatives of residuals: sensitivities of the runs where they give them, else finite differences
// between runs.
#pragma once

#include <functional>

#include "framework/calibrate/fitted_parameter.hpp"
#include "framework/calibrate/point_evaluation.hpp"
#include "geometry/types.hpp"

namespace tack {

// d residuals / d u at a point.
struct Derivatives {
  Eigen::MatrixXd jacobian;     // a row for each measured point, a column for each parameter
  std::string problem;          // reason why there are no derivatives; ""
  std::vector<bool> from_runs;  // per parameter: the runs gave its column
  // Per parameter with a column of finite differences: the reason; "" if they were asked for.
  std::vector<std::string> why;
  // Relative error of the runs' sensitivities: the fraction of the change of residuals to
  // `compared` nearby points that they do not predict.
  double missed = 0;
  int compared = 0;
  // Per parameter: relative error of its column, against slopes fitted to those points; empty if
  // the points do not determine slopes.
  std::vector<double> missed_of;
};

using EvaluateAll = std::function<std::vector<PointEvaluation>(const std::vector<DesignPoint>&)>;

// Computes the derivatives at the point u, whose evaluation is `middle`. Numbers without
// derivatives in `middle` get central differences of width `step`; one-sided at a bound, and where
// one of the two runs failed.
Derivatives derivatives_at(const std::vector<FittedParameter>& parameters,
                           const std::vector<double>& u, double step, const PointEvaluation& middle,
                           const EvaluateAll& evaluate);

// Compares the derivatives with the evaluations whose parameters are all within `radius` (in u),
// and fills in `missed`. Curves with sudden breaks have steps, which sensitivities of runs do not
// see.
void measure_accuracy(const std::vector<const PointEvaluation*>& others,
                      const std::vector<FittedParameter>& parameters, const PointEvaluation& middle,
                      double radius, Derivatives& d);

}  // namespace tack
