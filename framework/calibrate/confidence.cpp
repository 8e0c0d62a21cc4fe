#include "framework/calibrate/confidence.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "framework/config/words.hpp"

namespace tack {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double nothing = 1e-14;     // of the largest eigenvalue: rounding
constexpr double unnoticed = 0.005;   // of the largest power: not written
constexpr double too_far = 2;         // times the noise, at which the model misses something

std::string power(const std::string& name, double exponent) {
  if (std::abs(exponent - 1) < 0.005) return name;
  return fmt::format("{}^{:.2g}", name, exponent);
}

// A product of powers; where a scale is linear, a sum.
std::string text_of(const std::vector<FittedNumber>& numbers, const Eigen::VectorXd& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  const bool logs = std::all_of(numbers.begin(), numbers.end(), [](const FittedNumber& n) { return n.log; });
  std::string text;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const double exponent = v[i] / v[largest];
    if (std::abs(exponent) < unnoticed) continue;
    const FittedNumber& n = numbers[static_cast<size_t>(i)];
    if (logs) text += (text.empty() ? "" : " ") + power(n.name, exponent);
    else if (n.log) text += fmt::format("{}{:.2g} ln({})", text.empty() ? "" : " + ", exponent, n.name);
    else text += fmt::format("{}{:.2g} {}", text.empty() ? "" : " + ", exponent * 3 / (n.to - n.from), n.name);
  }
  return text;
}

std::string percent(double part) {
  return std::isfinite(part) ? fmt::format("{:.3g}%", 100 * part) : std::string("not at all");
}

void warn_of_undetermined(Confidence& c, const std::vector<FittedNumber>& numbers) {
  std::vector<std::string> unknown;
  for (size_t i = 0; i < numbers.size(); ++i)
    if (c.sigma[i] > largest_sigma)
      unknown.push_back(fmt::format("{} ({})", numbers[i].name, std::isfinite(c.sigma[i]) ? "standard deviation " + percent(c.sigma[i]) : "not at all"));
  if (unknown.empty()) return;
  std::vector<std::string> known;
  for (const DeterminedCombination& one : c.combinations)
    if (one.sigma <= largest_sigma) known.push_back(fmt::format("{} (to {})", one.text, percent(one.sigma)));
  c.warnings.push_back(fmt::format("the data do not determine {}; {}", listed(unknown),
                                   known.empty() ? "no combination of the numbers is determined" : "only " + listed(known) + (known.size() > 1 ? " are determined" : " is determined")));
}

void warn_of_bounds(Confidence& c, const std::vector<FittedNumber>& numbers, const std::vector<double>& values) {
  for (size_t i = 0; i < numbers.size(); ++i)
    for (const auto& [bound, name] : {std::pair(numbers[i].low(), "from"), std::pair(numbers[i].high(), "to")})
      if (std::abs(numbers[i].u(values[i]) - bound) < 1e-3)
        c.warnings.push_back(fmt::format("{} ended at its bound '{}', {:.6g}: the best value may lie beyond it", numbers[i].name, name, values[i]));
}

}  // namespace

Confidence confidence_of(const std::vector<FittedNumber>& numbers, const std::vector<double>& values, const Eigen::MatrixXd& jacobian,
                         const std::vector<double>& residuals, bool noise_known) {
  const Eigen::Index n = static_cast<Eigen::Index>(numbers.size());
  const double points = static_cast<double>(residuals.size()), free = points - static_cast<double>(n);
  double squares = 0;
  for (const double r : residuals) squares += r * r;
  Confidence c;
  const double left = free > 0 ? std::sqrt(squares / free) : nan;
  c.noise = noise_known ? 1 : left;
  if (!noise_known && free <= 0)
    c.warnings.push_back(fmt::format("{:.0f} measured points do not tell how sure {} numbers are: give their noise, or more points", points, n));
  if (noise_known && left > too_far)
    c.warnings.push_back(fmt::format("the best fit is off by {:.2g} times the noise: the model misses something that was measured, and intervals are too narrow", left));

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobian.transpose() * jacobian / (c.noise * c.noise));
  const Eigen::VectorXd& values_of_h = eigen.eigenvalues();
  const Eigen::MatrixXd& v = eigen.eigenvectors();
  const double top = std::max(values_of_h.maxCoeff(), 0.0);
  Eigen::VectorXd variance(n);
  for (Eigen::Index k = 0; k < n; ++k) variance[k] = values_of_h[k] > nothing * top ? 1 / values_of_h[k] : infinity;
  for (Eigen::Index k = n; k-- > 0;)
    c.combinations.push_back({std::sqrt(variance[k]), {v.col(k).data(), v.col(k).data() + n}, text_of(numbers, v.col(k))});

  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    if (std::isfinite(variance[k])) covariance += variance[k] * v.col(k) * v.col(k).transpose();
  c.correlation = Eigen::MatrixXd::Identity(n, n);
  const double t = noise_known || !(free > 0) ? 1.959964 : boost::math::quantile(boost::math::students_t(free), 0.975);
  for (Eigen::Index i = 0; i < n; ++i) {
    double sigma = std::sqrt(covariance(i, i));
    for (Eigen::Index k = 0; k < n; ++k)
      if (std::isinf(variance[k]) && std::abs(v(i, k)) > 1e-6) sigma = infinity;
    if (std::isnan(c.noise)) sigma = nan;
    c.sigma.push_back(sigma);
    const FittedNumber& number = numbers[static_cast<size_t>(i)];
    const double value = values[static_cast<size_t>(i)], width = std::isfinite(sigma) ? t * sigma : infinity;
    c.low.push_back(number.log ? value * std::exp(-width) : value - width * (number.to - number.from) / 3);
    c.high.push_back(number.log ? value * std::exp(width) : value + width * (number.to - number.from) / 3);
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      if (i != k) {
        const double both = c.sigma[static_cast<size_t>(i)] * c.sigma[static_cast<size_t>(k)];
        c.correlation(i, k) = std::isfinite(both) && both > 0 ? covariance(i, k) / both : nan;
      }
  warn_of_undetermined(c, numbers);
  warn_of_bounds(c, numbers, values);
  return c;
}

}  // namespace tack
