// Carries scripted vertices to their places when the straight way there is blocked.
// The vertices that still have to move become unknowns for a while, with a large mass K and their
// places as their prediction, so that their inertia is a pull towards the places:
//     E(x) = 1/2 |x - x~|_M^2 + 1/2 K sum_s |x_s - place_s|^2 + beta h^2 sum_i P_i(x)
// (the augmented Lagrangian of Li et al. 2020, Incremental Potential Contact, supplement A, without
// its multipliers). Every iteration is filtered like any other, so nothing is passed through, and
// the Hessian couples what pushes with what is pushed. Where a step of what is pulled, or one not much longer, is cut, only a part of
// the way is pulled next, and only that part of what others' inertia has to go: Newton's direction takes gaps and turns for small, and one that is cut time
// and again uses the gap up. The part grows again where steps are not cut; K grows where they bring little. Near the places the vertices are put
// exactly there, if that last move is free.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "framework/core/minimizer.hpp"
#include "framework/stepping/feasible_steps.hpp"
#include "framework/stepping/time_integrator.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

class ScriptWalk {
 public:
  ScriptWalk(World& world, const Minimizer& like, PhaseClock& clock, FeasibleSteps& steps);

  struct Result {
    MinimizerResult solve;  // sums over its minimisations
    VecX x;                 // 3n; feasible
    std::string failure;    // "" if the scripted vertices are exactly at their places in x
  };
  // From x, which is feasible, to a feasible configuration in which all vertices that differ between
  // x and places (3n) and are not free are at their places.
  // `observer` is told of every iteration on the way.
  Result run(const VecX& x, const VecX& places, const TimeIntegrator::Prediction& prediction,
             const MinimizerProblem::Observer& observer = {});

 private:
  struct Pull;
  void prepare(const VecX& x, const VecX& places);
  std::vector<HeldDirections> held_directions() const;  // in the walk
  VecX masses(double pull, bool inertia) const;
  double stiffness(const VecX& x, const TimeIntegrator::Prediction& prediction);
  void minimize(Pull& pull, Result& result, const MinimizerProblem::Observer& observer);
  bool arrive(const VecX& places, VecX& x) const;
  std::string failure(const VecX& x, const VecX& places) const;

  World& world_;
  std::unique_ptr<Minimizer> minimizer_;  // its own: the factors that it keeps are those of its unknowns
  PhaseClock& clock_;
  FeasibleSteps& steps_;
  std::vector<int> moving_;  // the scripted vertices that have to move
  DofMap dofs_;              // the free and the moving vertices
  std::optional<StepPotential> potential_;
};

}  // namespace tack
