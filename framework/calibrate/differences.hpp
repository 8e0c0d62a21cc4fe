// Derivatives of residuals by differences of runs.
#pragma once

#include <functional>

#include "framework/calibrate/search.hpp"

namespace tack {

using EvaluateAll = std::function<std::vector<PointEvaluation>(const std::vector<Point>&)>;

// Central differences of `step` around the point u; to one side at a bound, and where the run at the other failed.
Derivatives differences(const std::vector<FittedNumber>& numbers, const std::vector<double>& u, double step, const PointEvaluation& middle,
                        const EvaluateAll& evaluate);

}  // namespace tack
