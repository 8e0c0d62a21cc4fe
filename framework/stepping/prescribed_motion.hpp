// Prescribed motion of a step: moves vertices to their prescribed positions at its end, before the
// minimisation, through whatever is in their way.
//
// 1. Along linear trajectories, with the predicted motion of the free vertices, if these are
//    feasible and debond no stencils (predicted_motion.hpp).
// 2. Otherwise by the augmented Lagrangian of Li et al. 2020, Incremental Potential Contact,
//    supplement A. The prescribed vertices V become unknowns of the incremental potential E:
//        L(x) = E(x) + K/2 sum_V |x_v - t_v|^2 - sum_V lambda_v . (x_v - t_v),
//    with targets t, a penalty K and multipliers lambda. L equals E with masses K and predictions
//    t + lambda / K at V, so that any minimiser minimises it as it does E, by feasible steps. The
//    multipliers are updated after each minimisation, or K grows (penalty_rule.hpp). Close to their
//    targets the vertices are set to them exactly, if that is feasible.
//
// The vertices of a rigid motion move as one affine body of up to four control vertices
// (affine_controls.hpp): they cannot intersect each other on the way, and pairs among them are not
// searched. Free vertices debond in short steps only, so that a bond passes the peak of its
// traction where the motion takes it there, not where a long step jumps over it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "framework/core/minimizer.hpp"
#include "framework/stepping/feasible_steps.hpp"
#include "framework/stepping/iterate_check.hpp"
#include "framework/stepping/stepper.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

// Parameters of the augmented Lagrangian.
struct MotionPenalty {
  double stiffness = 1000;  // first K, over the mean diagonal of the Hessian at V without it
  double remainder = 0.01;  // fraction of the displacement that may be left when targets are set
  void fields(Fields& f);
};

class PrescribedMotionSolver {
 public:
  // like: the minimiser of the steps. All arguments must outlive the object.
  PrescribedMotionSolver(World& world, const Minimizer& like, PhaseClock& clock,
                         FeasibleSteps& steps, const MotionPenalty& penalty)
      : world_(world), like_(like), clock_(clock), steps_(steps), penalty_(penalty) {}

  struct Result {
    MinimizerResult solve;  // summed over all minimisations
    VecX x;                 // 3n; feasible
    std::string failure;    // "" if all prescribed vertices are exactly at their targets in x
  };
  // Called if other vertices are fixed than before.
  void reset() { potential_.reset(); }
  // Moves the prescribed vertices from the state of the step to their targets, in substeps of
  // limited rotation. In the end, the potential of the step has begun again at the targets.
  // check: may be null. Every iteration notifies `observer`.
  Result solve(const Step& step, IterateCheck* check, const MinimizerProblem::Observer& observer);

 private:
  struct Context {
    const Step& step;
    IterateCheck* check;
    const MinimizerProblem::Observer& observer;
  };
  // Displacements of the unknowns in a substep: h v + h^2 a and h v. Empty without inertia.
  struct FreeMotion {
    VecX full, uniform;
  };
  Result move(const VecX& x, const VecX& targets, const FreeMotion& free, const Context& context);
  Result move_linearly(const VecX& x, const VecX& targets, const std::vector<VecX>& displacements,
                       StepPotential& potential);
  Result push(const VecX& x, const VecX& targets, const Context& context);
  void set_unknowns(const VecX& x, const VecX& targets, const Step& step);
  std::vector<const PrescribedMotion::Assignment*> rigid_motions(const Step& step) const;
  Dependences rigid_dependences(const std::vector<const PrescribedMotion::Assignment*>& rigid,
                                const VecX& x, const VecX& targets) const;
  std::vector<FixedDirections> fixed_directions() const;
  VecX masses(double stiffness, bool inertia) const;
  double first_penalty(const VecX& x, const TimeIntegrator::Prediction& prediction);
  double distance(const VecX& x, const VecX& targets) const;
  double feasible_step(const VecX& q, const VecX& p);
  double own_step(const VecX& p) const;
  void minimize(Result& result, const std::function<double(const VecX& p)>& norm,
                const MinimizerProblem::Observer& observer);
  bool set_targets(const VecX& targets, VecX& x) const;
  std::string failure(const VecX& x, const VecX& targets) const;

  World& world_;
  const Minimizer& like_;
  PhaseClock& clock_;
  FeasibleSteps& steps_;
  const MotionPenalty& penalty_;
  std::unique_ptr<Minimizer> minimizer_;  // with factors of these unknowns; null until first needed
  std::vector<int> moving_;    // V, ascending: fixed vertices that move and depend on no others
  Dependences dependences_;    // of the world, and of V on control vertices
  std::vector<double> share_;  // per vertex: number of vertices of V for which its penalty stands
  DofMap dofs_;                // over the free vertices and V
  std::optional<StepPotential> potential_;
};

}  // namespace tack
