// How well energy and forces are in balance in the steps of a run.
#pragma once

#include <filesystem>

namespace tack {

struct StepsVerdict {
  // Energy that contact areas and the integrator took in all, of the largest energy in the run.
  double lost = 0;
  double made = 0;        // what they made, in the steps in which they did
  // The largest force that nothing balances, over what is tolerated in its step.
  double unbalanced = 0;
};

// From a run's steps.csv. The largest energy: that of all kinds but gravity, with gravity's way
// from its lowest to its highest, and what was put in or taken out if that is more.
StepsVerdict judge_steps(const std::filesystem::path& steps);

}  // namespace tack
