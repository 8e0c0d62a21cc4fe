// Follower of prescribed motion: moves prescribed vertices to their target positions at the end of
// a step, before the minimisation. They move along linear trajectories if these are feasible and
// debond no stencils (predicted_motion.hpp), otherwise by Dirichlet continuation
// (dirichlet_continuation.hpp).
#pragma once

#include <optional>

#include "framework/stepping/iterate_check.hpp"
#include "framework/stepping/dirichlet_continuation.hpp"
#include "framework/stepping/stepper.hpp"

namespace tack {

class PrescribedMotionFollower {
 public:
  PrescribedMotionFollower(World& world, const Minimizer& like, PhaseClock& clock,
                           FeasibleSteps& steps)
      : world_(world), like_(like), clock_(clock), steps_(steps) {}

  // Called if other vertices are fixed than before.
  void reset() { continuation_.reset(); }

  // Moves the prescribed vertices from the state of the step to their target positions, in substeps
  // of limited rotation. Returns a feasible start of the step, at which the potential of the step
  // has begun again. check: may be null.
  DirichletContinuation::Result follow(const Step& step, IterateCheck* check,
                                       const MinimizerProblem::Observer& observer);

 private:
  struct Context {
    const Step& step;
    IterateCheck* check;
    const MinimizerProblem::Observer& observer;
  };
  // Displacements of the unknowns in a substep: h v + h^2 a and h v.
  struct FreeMotion {
    VecX full, uniform;
  };
  // free_motion: null without inertia.
  DirichletContinuation::Result move(const VecX& x, const VecX& targets,
                                     const FreeMotion* free_motion, const Context& context);
  DirichletContinuation::Result move_linearly(const VecX& x, const VecX& targets,
                                              const std::vector<VecX>& displacements,
                                              StepPotential& potential);
  DirichletContinuation::Result run_continuation(const VecX& x, const VecX& targets,
                                                 const Context& context);

  World& world_;
  const Minimizer& like_;
  PhaseClock& clock_;
  FeasibleSteps& steps_;
  std::optional<DirichletContinuation> continuation_;  // empty until first needed
};

}  // namespace tack
