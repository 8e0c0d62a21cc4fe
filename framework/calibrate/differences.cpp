#include "framework/calibrate/differences.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tack {

Derivatives differences(const std::vector<FittedNumber>& numbers, const std::vector<double>& u, double step, const PointEvaluation& middle,
                        const EvaluateAll& evaluate) {
  std::vector<Point> points;
  for (size_t i = 0; i < numbers.size(); ++i)
    for (const double side : {-1.0, 1.0}) {
      Point p = middle.values;
      p[i] = numbers[i].value(std::clamp(u[i] + side * step, numbers[i].low(), numbers[i].high()));
      points.push_back(std::move(p));
    }
  const std::vector<PointEvaluation> found = evaluate(points);
  Derivatives d{Eigen::MatrixXd::Zero(static_cast<long>(middle.residuals.size()), static_cast<long>(numbers.size())), ""};
  const auto residuals = [](const PointEvaluation& e) { return Eigen::Map<const Eigen::VectorXd>(e.residuals.data(), static_cast<long>(e.residuals.size())); };
  for (size_t i = 0; i < numbers.size(); ++i) {
    const PointEvaluation& low = found[2 * i].good ? found[2 * i] : middle;
    const PointEvaluation& high = found[2 * i + 1].good ? found[2 * i + 1] : middle;
    const double width = numbers[i].u(high.values[i]) - numbers[i].u(low.values[i]);
    if (!(width > 0)) {
      d.problem = fmt::format("the runs beside the best one failed, with another {}", numbers[i].name);
      continue;
    }
    d.of_residuals.col(static_cast<long>(i)) = (residuals(high) - residuals(low)) / width;
  }
  return d;
}

}  // namespace tack
