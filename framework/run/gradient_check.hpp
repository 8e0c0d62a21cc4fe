// Check of a probe's derivative by a scene parameter (framework/sensitivity) against central
// differences of whole runs.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/experiment/load_experiment.hpp"

namespace tack {

struct GradientCheck {
  double number, step;  // SI; the runs have number - step and number + step
  // At times where all runs have samples and all values are finite.
  std::vector<double> times, gradients, differences;
  double largest = 0;           // largest absolute difference quotient
  double largest_gradient = 0;  // largest absolute sensitivity
  double largest_value = 0;     // largest absolute value of the probe [SI]
  size_t worst = 0;             // index of the largest error
  double median_error = 0;      // median error
  double cost = 0;              // user time of steps with the gradient over that without
  std::vector<Warning> warnings;

  // Returns true if the difference quotients are all zero but for round-off of the probe: relative
  // errors have no meaning then.
  bool nothing_to_compare() const;
  double error(size_t i) const {
    return largest > 0 ? std::abs(gradients[i] - differences[i]) / largest : 0;
  }
};

// Runs the check. column: of probes.csv. relative_step: relative to the parameter, or in SI if that
// is zero. Throws InputError for an unknown column or key, and SimulationError for a run that
// fails.
GradientCheck check_gradient(const LoadedExperiment& loaded, const std::string& column,
                             const std::string& key, double relative_step);

}  // namespace tack
