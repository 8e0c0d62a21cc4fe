// Confidence in fitted parameters: how well the data determine them. Residuals are assumed to be
// linear around the best point.
//
// With J = d residuals / d u and the standard deviation s of a residual, for independent errors:
//   H = J^T J / s^2,  C = H^-1
//   s = 1 for known noise (residuals are in units of it), else |r| / sqrt(points - parameters)
//
// Corrections to C:
// - Correlated residuals (correlated noise, or a model error): n points determine as much as n /
//   tau, with tau their integrated autocorrelation time; C is multiplied by tau.
// - Residuals above the known noise: C is multiplied by chi^2 per degree of freedom (Birge).
//
// Intervals hold the true value with 95%: +-t s_i, with t of Student's distribution for n / tau -
// parameters degrees of freedom, or 1.96. They do not include the bias of a wrong model: `fits` is
// false if there is evidence of one.
//
// Eigenvectors of H with large eigenvalues are the combinations that the data determine: v_1 ln a +
// v_2 ln b is that of a^v_1 b^v_2.
#pragma once

#include <string>
#include <vector>

#include "framework/calibrate/fitted_parameter.hpp"
#include "framework/core/warning.hpp"
#include "geometry/types.hpp"

namespace tack {

struct DeterminedCombination {
  double sigma = 0;             // of v . u; infinite if the data do not depend on it
  std::vector<double> weights;  // v, of length 1
  std::string text;             // "strength^0.02 work", the largest power being 1
};

// Statistics of the best fit's residuals, as evidence of its errors.
struct ResidualStatistics {
  double points = 0;
  double correlation = 0;       // of neighbours; 0 where it could be chance
  double effective_points = 0;  // points / tau
  // Sum of the squared residuals, in units of the noise where it is known, per degree of freedom;
  // NaN without such degrees.
  double chi_squared = 0;
  double chi_squared_limit = 0;  // noise alone exceeds it in 1 of 100 fits; NaN for unknown noise
};

// Computes the statistics. series: number of successive residuals of each experiment; empty: one
// series.
ResidualStatistics residual_statistics(const std::vector<double>& residuals, size_t parameters,
                                       bool noise_known, const std::vector<size_t>& series = {});

struct Confidence {
  double noise = 1;  // s; of residuals
  ResidualStatistics residuals;
  bool fits = true;  // no evidence of a model error
  // Standard deviation of u: 0.05 is 5% of the value on a logarithmic scale; infinite if the data
  // do not determine it.
  std::vector<double> sigma;
  // 95% interval of the values. On a logarithmic scale never below zero; infinite if the data do
  // not determine it.
  std::vector<double> low, high;
  Eigen::MatrixXd correlation;                      // of u; NaN where a sigma is infinite
  std::vector<DeterminedCombination> combinations;  // the best determined one first
  std::vector<Warning> warnings;
};

// A parameter with a larger sigma counts as not determined.
inline constexpr double determined_sigma_max = 0.25;

// Computes the confidence at the best point `values`. `noise_known`: residuals are in units of the
// noise. `series`: as for residual_statistics.
Confidence find_confidence(const std::vector<FittedParameter>& parameters,
                           const std::vector<double>& values, const Eigen::MatrixXd& jacobian,
                           const std::vector<double>& residuals, bool noise_known,
                           const std::vector<size_t>& series = {});

}  // namespace tack
