// A derivative of a probe by a number of the scene (framework/sensitivity) beside central differences of whole runs.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/experiment/load_experiment.hpp"

namespace tack {

struct GradientCheck {
  double number, step;  // SI: the runs have number - step and number + step
  std::vector<double> times, gradients, differences;  // where all runs have a sample and numbers are finite
  double largest = 0;   // difference, of either sign
  size_t worst = 0;     // where they differ most
  double middle = 0;    // by how much they differ at half of the times or more
  double cost = 0;      // user time of the run with the gradient over that of one without
  std::vector<Warning> doubts;

  double error(size_t i) const { return largest > 0 ? std::abs(gradients[i] - differences[i]) / largest : 0; }
};

// column: of probes.csv. relative_step: of the number, or in SI if that is zero. Throws InputError for a column or key that there is none of, and
// SimulationError for a run that fails.
GradientCheck check_gradient(const LoadedExperiment& loaded, const std::string& column, const std::string& key, double relative_step);

}  // namespace tack
