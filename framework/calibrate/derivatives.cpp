#include "framework/calibrate/derivatives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

Eigen::Map<const Eigen::VectorXd> vector_of(const std::vector<double>& v) { return {v.data(), static_cast<long>(v.size())}; }

}  // namespace

Derivatives derivatives_at(const std::vector<FittedNumber>& numbers, const std::vector<double>& u, double step, const PointEvaluation& middle,
                           const EvaluateAll& evaluate) {
  Derivatives d{Eigen::MatrixXd::Zero(static_cast<long>(middle.residuals.size()), static_cast<long>(numbers.size())), "", {}, {}, 0, 0};
  std::vector<Point> points;
  for (size_t i = 0; i < numbers.size(); ++i) {
    d.by_runs.push_back(i < middle.derivatives.size() && !middle.derivatives[i].empty());
    for (const double side : {-1.0, 1.0}) {
      Point p = middle.values;
      p[i] = numbers[i].value(std::clamp(u[i] + side * step, numbers[i].low(), numbers[i].high()));
      if (!d.by_runs[i]) points.push_back(std::move(p));
    }
  }
  d.why.resize(numbers.size());
  const std::vector<PointEvaluation> found = points.empty() ? std::vector<PointEvaluation>() : evaluate(points);
  auto next = found.begin();
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (d.by_runs[i]) {
      d.of_residuals.col(static_cast<long>(i)) = vector_of(middle.derivatives[i]);
      continue;
    }
    const PointEvaluation& low = next->good ? *next : middle;
    ++next;
    const PointEvaluation& high = next->good ? *next : middle;
    ++next;
    const double width = numbers[i].u(high.values[i]) - numbers[i].u(low.values[i]);
    if (!(width > 0)) {
      d.problem = fmt::format("the runs beside the best one failed, with another {}", numbers[i].name);
      continue;
    }
    d.of_residuals.col(static_cast<long>(i)) = (vector_of(high.residuals) - vector_of(low.residuals)) / width;
  }
  return d;
}

void compare_with(const std::vector<const PointEvaluation*>& others, const std::vector<FittedNumber>& numbers, const PointEvaluation& middle, double reach,
                  Derivatives& d) {
  double missed = 0, all = 0;
  d.compared = 0;
  for (const PointEvaluation* other : others) {
    Eigen::VectorXd way(static_cast<long>(numbers.size()));
    for (size_t i = 0; i < numbers.size(); ++i) way[static_cast<long>(i)] = numbers[i].u(other->values[i]) - numbers[i].u(middle.values[i]);
    const double length = way.lpNorm<Eigen::Infinity>();
    if (!other->good || length == 0 || length > reach) continue;
    const Eigen::VectorXd change = vector_of(other->residuals) - vector_of(middle.residuals);
    missed += (change - d.of_residuals * way).squaredNorm();
    all += change.squaredNorm();
    ++d.compared;
  }
  d.missed = all > 0 ? std::sqrt(missed / all) : 0;
}

}  // namespace tack
