// Follows a prescribed motion: brings its vertices to their target positions at the end of a step,
// before the minimisation. They move along linear trajectories if nothing is in the way and no bond
// or adhesion lets go (predicted_motion.hpp), otherwise by Dirichlet continuation
// (dirichlet_continuation.hpp).
#pragma once

#include <optional>

#include "framework/stepping/iterate_check.hpp"
#include "framework/stepping/dirichlet_continuation.hpp"
#include "framework/stepping/stepper.hpp"

namespace tack {

class PrescribedMotionFollower {
 public:
  PrescribedMotionFollower(World& world, const Minimizer& like, PhaseClock& clock, FeasibleSteps& steps)
      : world_(world), like_(like), clock_(clock), steps_(steps) {}

  // Called when other vertices are fixed.
  void reset() { walk_.reset(); }

  // Moves the prescribed vertices from the state of the step to their target positions, in substeps
  // that rotate nothing too far. Returns a feasible start of the step, and begins the potential of
  // the step anew there. check: may be null.
  DirichletContinuation::Result follow(const Step& step, IterateCheck* check,
                                       const MinimizerProblem::Observer& observer);

 private:
  struct Way {
    const Step& step;
    IterateCheck* check;
    const MinimizerProblem::Observer& observer;
  };
  // along: h v + h^2 a and h v of the unknowns, of a part of the step; null without inertia.
  struct Along {
    VecX full, drift;
  };
  DirichletContinuation::Result move(const VecX& x, const VecX& places, const Along* along,
                                     const Way& way);
  DirichletContinuation::Result go_straight(const VecX& x, const VecX& places,
                                 const std::vector<VecX>& ways, StepPotential& potential);
  DirichletContinuation::Result walk(const VecX& x, const VecX& places, const Way& way);

  World& world_;
  const Minimizer& like_;
  PhaseClock& clock_;
  FeasibleSteps& steps_;
  std::optional<DirichletContinuation> walk_;  // made when it is first needed
};

}  // namespace tack
