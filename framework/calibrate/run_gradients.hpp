// Derivatives that a run computes itself: its request (output.gradients) and its results
// (gradients.csv).
#pragma once

#include <string>
#include <vector>

#include "framework/config/value.hpp"
#include "framework/output/gradient_config.hpp"
#include "framework/output/probes_csv.hpp"

namespace tack {

Value gradients_value(const std::vector<GradientConfig>& gradients);

// Returns the derivatives of a column of probes.csv at its samples, summed over `keys`; zero
// without keys and for the time. Empty if the run has none, or none that is finite.
std::vector<double> gradient_column(const ProbeSeries& gradients, const std::string& probe,
                                    const std::vector<std::string>& keys);

}  // namespace tack
