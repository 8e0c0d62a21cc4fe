#include "framework/calibrate/confidence.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "framework/config/words.hpp"

namespace tack {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double eigenvalue_min = 1e-14;  // relative to the largest eigenvalue: rounding
constexpr double exponent_min = 0.005;    // relative to the largest exponent; smaller ones are omitted
constexpr double false_alarm = 0.01;      // probability that noise alone makes a fit look wrong
// In standard deviations of the correlation of independent neighbours, 1 / sqrt(points).
constexpr double significant_correlation = 2;

std::string power(const std::string& name, double exponent) {
  if (std::abs(exponent - 1) < 0.005) return name;
  return fmt::format("{}^{:.2g}", name, exponent);
}

// Formats a combination as a product of powers; as a sum for linear scales.
std::string text_of(const std::vector<FittedParameter>& parameters, const Eigen::VectorXd& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  const bool logs = std::all_of(parameters.begin(), parameters.end(), [](const FittedParameter& n) { return n.log; });
  std::string text;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const double exponent = v[i] / v[largest];
    if (std::abs(exponent) < exponent_min) continue;
    const FittedParameter& n = parameters[static_cast<size_t>(i)];
    if (logs) text += (text.empty() ? "" : " ") + power(n.name, exponent);
    else if (n.log) text += fmt::format("{}{:.2g} ln({})", text.empty() ? "" : " + ", exponent, n.name);
    else text += fmt::format("{}{:.2g} {}", text.empty() ? "" : " + ", exponent * 3 / (n.to - n.from), n.name);
  }
  return text;
}

std::string percent(double fraction) {
  return std::isfinite(fraction) ? fmt::format("{:.3g}%", 100 * fraction) : std::string("not at all");
}

void warn_of_undetermined(Confidence& c, const std::vector<FittedParameter>& parameters) {
  std::vector<std::string> unknown;
  for (size_t i = 0; i < parameters.size(); ++i)
    if (c.sigma[i] > determined_sigma_max)
      unknown.push_back(fmt::format("{} ({})", parameters[i].name, std::isfinite(c.sigma[i]) ? "standard deviation " + percent(c.sigma[i]) : "not at all"));
  if (unknown.empty()) return;
  std::vector<std::string> known;
  for (const DeterminedCombination& one : c.combinations)
    if (one.sigma <= determined_sigma_max) known.push_back(fmt::format("{} (to {})", one.text, percent(one.sigma)));
  c.warnings.emplace_back(WarningKind::undetermined_value, fmt::format("the data do not determine {}; {}", listed(unknown),
                                   known.empty() ? "no combination of the parameters is determined" : "only " + listed(known) + (known.size() > 1 ? " are determined" : " is determined")));
}

void warn_of_bounds(Confidence& c, const std::vector<FittedParameter>& parameters, const std::vector<double>& values) {
  for (size_t i = 0; i < parameters.size(); ++i)
    for (const auto& [bound, name] : {std::pair(parameters[i].low(), "from"), std::pair(parameters[i].high(), "to")})
      if (std::abs(parameters[i].u(values[i]) - bound) < 1e-3)
        c.warnings.emplace_back(WarningKind::value_at_bound, fmt::format("{} ended at its bound '{}', {:.6g}: the best value may lie beyond it", parameters[i].name, name, values[i]));
}

// Correlation about zero, the mean of the residuals of a correct model: an offset counts as
// correlation too.
double autocorrelation(const std::vector<double>& r, const std::vector<size_t>& series, size_t lag) {
  double sum = 0, squares = 0;
  size_t first = 0;
  for (const size_t count : series) {
    for (size_t i = first; i < first + count; ++i) {
      squares += r[i] * r[i];
      if (i + lag < first + count) sum += r[i] * r[i + lag];
    }
    first += count;
  }
  return squares > 0 ? sum / squares : 0;
}

void warn_of_misfit(Confidence& c, bool noise_known) {
  const ResidualStatistics& r = c.residuals;
  const std::string correlation = r.correlation > 0 ? fmt::format("; residuals of neighbouring points are correlated ({:.2g}), so that {:.0f} points count as {:.3g}", r.correlation,
                                                            r.points, r.effective_points)
                                              : "";
  if (noise_known && r.chi_squared > r.chi_squared_limit) {
    c.fits = false;
    c.warnings.emplace_back(WarningKind::model_misfit, fmt::format("the RMS residual of the best fit is {:.2g} times the noise; noise alone exceeds {:.3g} in 1 of 100 fits{}: the model does not describe the "
                                     "data, or the noise is larger than given. Intervals are widened by that factor, and do not include model errors", std::sqrt(r.chi_squared),
                                     std::sqrt(r.chi_squared_limit), correlation));
  }
  if (c.fits && r.correlation > 0) {
    c.fits = false;
    c.warnings.emplace_back(WarningKind::model_misfit, fmt::format("the model does not describe the data, unless the noise itself is correlated{}; intervals do not include model errors", correlation));
  }
}

}  // namespace

ResidualStatistics residual_statistics(const std::vector<double>& residuals, size_t parameters, bool noise_known, const std::vector<size_t>& series) {
  ResidualStatistics s;
  const std::vector<size_t> lengths = series.empty() ? std::vector<size_t>{residuals.size()} : series;
  s.points = s.effective_points = static_cast<double>(residuals.size());
  double squares = 0;
  for (const double r : residuals) squares += r * r;
  const double free = s.points - static_cast<double>(parameters);
  s.chi_squared = free > 0 ? squares / free : nan;
  const double neighbours = autocorrelation(residuals, lengths, 1);
  if (neighbours > significant_correlation / std::sqrt(s.points)) {
    s.correlation = neighbours;
    double tau = 1;
    for (size_t lag = 1; lag < residuals.size(); ++lag) {  // up to the first negative value; the rest is noise
      const double one = autocorrelation(residuals, lengths, lag);
      if (one <= 0) break;
      tau += 2 * one;
    }
    s.effective_points = std::max(1.0, s.points / tau);
  }
  s.chi_squared_limit = noise_known && free > 0 ? boost::math::quantile(boost::math::chi_squared(free), 1 - false_alarm) / free : nan;
  return s;
}

Confidence find_confidence(const std::vector<FittedParameter>& parameters, const std::vector<double>& values, const Eigen::MatrixXd& jacobian,
                         const std::vector<double>& residuals, bool noise_known, const std::vector<size_t>& series) {
  const Eigen::Index n = static_cast<Eigen::Index>(parameters.size());
  const double points = static_cast<double>(residuals.size()), free = points - static_cast<double>(n);
  Confidence c;
  c.residuals = residual_statistics(residuals, parameters.size(), noise_known, series);
  c.noise = noise_known ? 1 : std::sqrt(c.residuals.chi_squared);
  // With fewer effective points, the fitted parameters absorb a larger part of the noise, so that the
  // residuals are smaller.
  const double effective = c.residuals.effective_points, degrees = std::max(1.0, effective - static_cast<double>(n));
  const double left = c.residuals.chi_squared * free * effective / (points * degrees);
  const double spread = std::sqrt((noise_known ? std::max(1.0, left) : left) * points / effective);
  if (!noise_known && free <= 0)
    c.warnings.emplace_back(WarningKind::few_points, fmt::format("{:.0f} measured points are too few for confidence intervals of {} parameters: give their noise, or more points", points, n));
  warn_of_misfit(c, noise_known);

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobian.transpose() * jacobian / (spread * spread));
  const Eigen::VectorXd& values_of_h = eigen.eigenvalues();
  const Eigen::MatrixXd& v = eigen.eigenvectors();
  const double top = std::max(values_of_h.maxCoeff(), 0.0);
  Eigen::VectorXd variance(n);
  for (Eigen::Index k = 0; k < n; ++k) variance[k] = values_of_h[k] > eigenvalue_min * top ? 1 / values_of_h[k] : infinity;
  for (Eigen::Index k = n; k-- > 0;)
    c.combinations.push_back({std::sqrt(variance[k]), {v.col(k).data(), v.col(k).data() + n}, text_of(parameters, v.col(k))});

  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    if (std::isfinite(variance[k])) covariance += variance[k] * v.col(k) * v.col(k).transpose();
  c.correlation = Eigen::MatrixXd::Identity(n, n);
  // If the noise is estimated from the residuals, few residuals make it uncertain.
  const bool estimated = free > 0 && (!noise_known || c.residuals.correlation > 0);
  const double t = estimated ? boost::math::quantile(boost::math::students_t(degrees), 0.975) : 1.959964;
  for (Eigen::Index i = 0; i < n; ++i) {
    double sigma = std::sqrt(covariance(i, i));
    for (Eigen::Index k = 0; k < n; ++k)
      if (std::isinf(variance[k]) && std::abs(v(i, k)) > 1e-6) sigma = infinity;
    if (std::isnan(c.noise)) sigma = nan;
    c.sigma.push_back(sigma);
    const FittedParameter& parameter = parameters[static_cast<size_t>(i)];
    const double value = values[static_cast<size_t>(i)], width = std::isfinite(sigma) ? t * sigma : infinity;
    c.low.push_back(parameter.log ? value * std::exp(-width) : value - width * (parameter.to - parameter.from) / 3);
    c.high.push_back(parameter.log ? value * std::exp(width) : value + width * (parameter.to - parameter.from) / 3);
  }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      if (i != k) {
        const double both = c.sigma[static_cast<size_t>(i)] * c.sigma[static_cast<size_t>(k)];
        c.correlation(i, k) = std::isfinite(both) && both > 0 ? covariance(i, k) / both : nan;
      }
  warn_of_undetermined(c, parameters);
  warn_of_bounds(c, parameters, values);
  return c;
}

}  // namespace tack
