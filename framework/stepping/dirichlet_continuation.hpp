// Dirichlet continuation: moves vertices of a prescribed motion to their target positions when the
// linear trajectory there is blocked.
//
// The vertices that still have to move become unknowns, with a large mass K and the targets as
// their prediction, so that their inertia is a penalty:
//     E(x) = 1/2 |x - x~|_M^2 + 1/2 K sum_s |x_s - target_s|^2 + beta h^2 sum_i P_i(x)
// (the augmented Lagrangian of Li et al. 2020, Incremental Potential Contact, supplement A, without
// its multipliers). Every iteration is filtered by CCD like any other, so that nothing is passed
// through, and the Hessian couples the obstacle with the vertices that push it.
//
// If CCD truncates a step, or one not much longer, only a fraction of the remaining displacement is
// requested next, of the inertial target of the free vertices too: the Newton direction is linear,
// and repeated truncation consumes the gap to the obstacle. The fraction grows while steps are not
// truncated, K grows while progress is slow. Close to their targets vertices are set to them
// exactly, if CCD allows it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "framework/core/minimizer.hpp"
#include "framework/stepping/feasible_steps.hpp"
#include "framework/stepping/time_integrator.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

class DirichletContinuation {
 public:
  DirichletContinuation(World& world, const Minimizer& like, PhaseClock& clock,
                        FeasibleSteps& steps);

  struct Result {
    MinimizerResult solve;  // summed over its minimisations
    VecX x;                 // 3n; feasible
    std::string failure;    // "" if all prescribed vertices are exactly at their targets in x
  };
  // Moves from x, which is feasible, to a feasible configuration in which all prescribed vertices
  // are at their positions in `targets` (3n). Every iteration notifies `observer`.
  Result run(const VecX& x, const VecX& targets, const TimeIntegrator::Prediction& prediction,
             const MinimizerProblem::Observer& observer = {});

 private:
  struct Stage;
  void prepare(const VecX& x, const VecX& targets);
  std::vector<FixedDirections> fixed_directions() const;
  VecX masses(double stiffness, bool inertia) const;
  double stiffness(const VecX& x, const TimeIntegrator::Prediction& prediction);
  void minimize(Stage& stage, Result& result, const MinimizerProblem::Observer& observer);
  bool move_to_targets(const VecX& targets, VecX& x) const;
  std::string failure(const VecX& x, const VecX& targets) const;

  World& world_;
  std::unique_ptr<Minimizer> minimizer_;  // with stored factors of these unknowns
  PhaseClock& clock_;
  FeasibleSteps& steps_;
  std::vector<int> moving_;  // prescribed vertices that have to move
  DofMap dofs_;              // the free and the moving vertices
  std::optional<StepPotential> potential_;
};

}  // namespace tack
