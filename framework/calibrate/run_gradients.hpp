// The derivatives that a run gives itself: what it is asked for (output.gradients), and what its gradients.csv has.
#pragma once

#include <string>
#include <vector>

#include "framework/config/value.hpp"
#include "framework/output/gradient_config.hpp"
#include "framework/output/probes_csv.hpp"

namespace tack {

Value gradients_value(const std::vector<GradientConfig>& gradients);

// Derivatives of a column of probes.csv at its samples by what several keys take, the sum of those by each; zero without keys, and of the time. Empty
// where the run has none, or none that is finite.
std::vector<double> gradient_column(const ProbeSeries& gradients, const std::string& probe, const std::vector<std::string>& keys);

}  // namespace tack
