// Checks that the first step of a run without inertia has an equilibrium
// (stepping/free_bodies.hpp): a body that nothing supports ends the run, and `tack check` finds it
// in advance. Loads are those of the first step; a load that lifts a body off later is found in the
// run.
#pragma once

#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/world/world.hpp"

namespace tack {

struct EquilibriumCheck {
  std::string error;  // the run cannot do its first step; empty: it may
  std::vector<Warning> warnings;
};

// Returns neither an error nor warnings for a run with inertia. Leaves contact at the start.
EquilibriumCheck check_equilibrium(const Experiment& experiment, World& world, PhaseClock& clock);

}  // namespace tack
