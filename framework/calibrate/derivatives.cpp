#include "framework/calibrate/derivatives.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace tack {
namespace {

// Fraction of the radius: points that spread by less in some direction do not determine a slope.
constexpr double spread_min = 0.02;

Eigen::Map<const Eigen::VectorXd> vector_of(const std::vector<double>& v) { return {v.data(), static_cast<long>(v.size())}; }

}  // namespace

Derivatives derivatives_at(const std::vector<FittedParameter>& parameters, const std::vector<double>& u, double step, const PointEvaluation& middle,
                           const EvaluateAll& evaluate) {
  Derivatives d{Eigen::MatrixXd::Zero(static_cast<long>(middle.residuals.size()), static_cast<long>(parameters.size())), "", {}, {}, 0, 0, {}};
  std::vector<DesignPoint> points;
  for (size_t i = 0; i < parameters.size(); ++i) {
    d.from_runs.push_back(i < middle.derivatives.size() && !middle.derivatives[i].empty());
    for (const double side : {-1.0, 1.0}) {
      DesignPoint p = middle.values;
      p[i] = parameters[i].value(std::clamp(u[i] + side * step, parameters[i].low(), parameters[i].high()));
      if (!d.from_runs[i]) points.push_back(std::move(p));
    }
  }
  d.why.resize(parameters.size());
  const std::vector<PointEvaluation> found = points.empty() ? std::vector<PointEvaluation>() : evaluate(points);
  auto next = found.begin();
  for (size_t i = 0; i < parameters.size(); ++i) {
    if (d.from_runs[i]) {
      d.jacobian.col(static_cast<long>(i)) = vector_of(middle.derivatives[i]);
      continue;
    }
    const PointEvaluation& low = next->good ? *next : middle;
    ++next;
    const PointEvaluation& high = next->good ? *next : middle;
    ++next;
    const double width = parameters[i].u(high.values[i]) - parameters[i].u(low.values[i]);
    if (!(width > 0)) {
      d.problem = fmt::format("the runs for finite differences by {} failed", parameters[i].name);
      continue;
    }
    d.jacobian.col(static_cast<long>(i)) = (vector_of(high.residuals) - vector_of(low.residuals)) / width;
  }
  return d;
}

void measure_accuracy(const std::vector<const PointEvaluation*>& others, const std::vector<FittedParameter>& parameters, const PointEvaluation& middle, double radius,
                  Derivatives& d) {
  const auto n = static_cast<long>(parameters.size());
  double missed = 0, all = 0;
  d.compared = 0;
  Eigen::MatrixXd displacements = Eigen::MatrixXd::Zero(n, n), misses = Eigen::MatrixXd::Zero(d.jacobian.rows(), n);  // sums of w w^T, of e w^T
  for (const PointEvaluation* other : others) {
    Eigen::VectorXd displacement(n);
    for (size_t i = 0; i < parameters.size(); ++i) displacement[static_cast<long>(i)] = parameters[i].u(other->values[i]) - parameters[i].u(middle.values[i]);
    const double length = displacement.lpNorm<Eigen::Infinity>();
    if (!other->good || length == 0 || length > radius) continue;
    const Eigen::VectorXd change = vector_of(other->residuals) - vector_of(middle.residuals);
    const Eigen::VectorXd miss = change - d.jacobian * displacement;
    missed += miss.squaredNorm();
    all += change.squaredNorm();
    displacements += displacement * displacement.transpose();
    misses += miss * displacement.transpose();
    ++d.compared;
  }
  d.missed = all > 0 ? std::sqrt(missed / all) : 0;
  d.missed_of.clear();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(displacements);
  if (d.compared < 2 * n + 1 || !(eigen.eigenvalues()[0] > spread_min * radius * spread_min * radius * d.compared)) return;
  const Eigen::MatrixXd off = eigen.operatorInverseSqrt() * eigen.operatorInverseSqrt() * misses.transpose();
  for (long i = 0; i < n; ++i) d.missed_of.push_back(off.row(i).norm() / std::max(d.jacobian.col(i).norm(), 1e-300));
}

}  // namespace tack
