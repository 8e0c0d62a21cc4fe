// Energy balance and force residuals of the steps of a run.
#pragma once

#include <filesystem>

namespace tack {

struct StepsBalance {
  // Numerical energy loss by contact areas and the integrator, over the largest energy in the run.
  double energy_loss = 0;
  double energy_gain = 0;     // numerical energy gain, summed over the steps with a gain
  double force_residual = 0;  // largest force residual over its limit
};

// Returns the balance from the steps.csv of a run. Its largest energy is the largest of the sum of
// all kinds without gravity, the numerical loss and the external work, plus the range of the energy
// of gravity.
StepsBalance steps_balance(const std::filesystem::path& steps);

}  // namespace tack
