// Retraction of minimiser steps: lets the affine bodies of a world rotate without strain.
#pragma once

#include "framework/affine/orthogonality_term.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

// Sets the retraction of a problem. World and potential must outlive the problem.
inline void set_retraction(const World& world, const StepPotential& potential,
                           MinimizerProblem& problem) {
  if (!world.affine) return;
  problem.retract = [&](const VecX& from, VecX& p, double loss) {
    return world.affine->retract(potential.dofs(), from, p, loss / potential.scale());
  };
}

}  // namespace tack
