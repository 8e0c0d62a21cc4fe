// Brings scripted vertices to their places at the end of a step, before the minimisation: the straight way if nothing
// is in it and nothing lets go on it (predicted_motion.hpp), a walk otherwise (dirichlet_continuation.hpp).
#pragma once

#include <optional>

#include "framework/stepping/iterate_check.hpp"
#include "framework/stepping/dirichlet_continuation.hpp"
#include "framework/stepping/stepper.hpp"

namespace tack {

class ScriptFollower {
 public:
  ScriptFollower(World& world, const Minimizer& like, PhaseClock& clock, FeasibleSteps& steps)
      : world_(world), like_(like), clock_(clock), steps_(steps) {}

  // Other vertices are held now.
  void reset() { walk_.reset(); }

  // From the step's state to a feasible start of it with the scripted vertices at their places, to which they are
  // moved in parts that turn nothing too far. The step's potential is begun anew at the places. check: may be null.
  DirichletContinuation::Result follow(const Step& step, IterateCheck* check, const MinimizerProblem::Observer& observer);

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
  DirichletContinuation::Result move(const VecX& x, const VecX& places, const Along* along, const Way& way);
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
