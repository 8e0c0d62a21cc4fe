#include "solvers/steps/step_policy.hpp"

namespace tack {

StepPolicies default_step_policies() {
  StepPolicies policies;
  for (const char* name : {"conjugation", "retraction", "straight", "extrapolation"}) policies.push_back(Registry<StepPolicy>::make(name));
  return policies;
}

}  // namespace tack
