#include "framework/calibrate/derivatives.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace tack {
namespace {

// Fraction of the reach: points that spread by less in some direction do not determine a slope.
constexpr double narrow = 0.02;

Eigen::Map<const Eigen::VectorXd> vector_of(const std::vector<double>& v) { return {v.data(), static_cast<long>(v.size())}; }

}  // namespace

Derivatives derivatives_at(const std::vector<FittedNumber>& numbers, const std::vector<double>& u, double step, const PointEvaluation& middle,
                           const EvaluateAll& evaluate) {
  Derivatives d{Eigen::MatrixXd::Zero(static_cast<long>(middle.residuals.size()), static_cast<long>(numbers.size())), "", {}, {}, 0, 0, {}};
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
  const auto n = static_cast<long>(numbers.size());
  double missed = 0, all = 0;
  d.compared = 0;
  Eigen::MatrixXd ways = Eigen::MatrixXd::Zero(n, n), misses = Eigen::MatrixXd::Zero(d.of_residuals.rows(), n);  // sums of w w^T, of e w^T
  for (const PointEvaluation* other : others) {
    Eigen::VectorXd way(n);
    for (size_t i = 0; i < numbers.size(); ++i) way[static_cast<long>(i)] = numbers[i].u(other->values[i]) - numbers[i].u(middle.values[i]);
    const double length = way.lpNorm<Eigen::Infinity>();
    if (!other->good || length == 0 || length > reach) continue;
    const Eigen::VectorXd change = vector_of(other->residuals) - vector_of(middle.residuals);
    const Eigen::VectorXd miss = change - d.of_residuals * way;
    missed += miss.squaredNorm();
    all += change.squaredNorm();
    ways += way * way.transpose();
    misses += miss * way.transpose();
    ++d.compared;
  }
  d.missed = all > 0 ? std::sqrt(missed / all) : 0;
  d.missed_of.clear();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(ways);
  if (d.compared < 2 * n + 1 || !(eigen.eigenvalues()[0] > narrow * reach * narrow * reach * d.compared)) return;
  const Eigen::MatrixXd off = eigen.operatorInverseSqrt() * eigen.operatorInverseSqrt() * misses.transpose();
  for (long i = 0; i < n; ++i) d.missed_of.push_back(off.row(i).norm() / std::max(d.of_residuals.col(i).norm(), 1e-300));
}

}  // namespace tack
