#include "framework/stepping/prescribed_motion_follower.hpp"

#include <limits>

#include "framework/stepping/fixed_vertices.hpp"
#include "framework/stepping/predicted_motion.hpp"

namespace tack {
namespace {

// Largest fraction of the feasible step of free vertices that is used: the rest would leave no gap.
constexpr double usable_fraction = 0.9;

}  // namespace

DirichletContinuation::Result PrescribedMotionFollower::follow(const Step& step, IterateCheck* check,
                                          const MinimizerProblem::Observer& observer) {
  const State& state = step.state;
  const TimeIntegrator::Prediction& prediction = step.prediction;
  const int substeps = step.fixed.rotation_substeps(state.time, step.h);
  FreeMotion free_motion;
  if (prediction.inertia) {
    world_.dofs.gather(step.h / substeps * (state.v + step.h * state.a), free_motion.full);
    world_.dofs.gather(step.h / substeps * state.v, free_motion.uniform);
  }
  const Context context{step, check, observer};
  DirichletContinuation::Result result{{}, state.x, ""};
  for (int i = 1; i <= substeps; ++i) {
    VecX targets = result.x;
    step.fixed.set_positions(state.time + step.h * i / substeps, targets);
    step.potential.begin_step(targets, prediction.x, prediction.scales(), prediction.inertia);
    if (i > 1) world_.participants.move_to(result.x);
    const MinimizerResult before = result.solve;
    result = move(result.x, targets, prediction.inertia ? &free_motion : nullptr, context);
    result.solve.add_work(before);
    if (!result.failure.empty() || result.solve.status != MinimizerStatus::converged) break;
  }
  return result;
}

// Moves from x to the target positions of the prescribed vertices: along linear trajectories, with the
// predicted motion of the free vertices, or by Dirichlet continuation if these are blocked or debond
// stencils. If the continuation cannot avoid debonding either, linear trajectories are used again.
DirichletContinuation::Result PrescribedMotionFollower::move(const VecX& x, const VecX& targets, const FreeMotion* free_motion, const Context& context) {
  const VecX none = VecX::Zero(world_.dofs.size());
  const PredictedMotion predicted = predicted_motion(world_, x, targets - x, free_motion ? free_motion->full : none, free_motion ? free_motion->uniform : none);
  if (!predicted.debonds) {
    DirichletContinuation::Result linear = move_linearly(x, targets, predicted.displacements, context.step.potential);
    if (linear.x.size() > 0) return linear;
    return run_continuation(x, targets, context);
  }
  DirichletContinuation::Result continued = run_continuation(x, targets, context);
  if (continued.failure.empty()) return continued;
  DirichletContinuation::Result linear = move_linearly(x, targets, {free_motion ? free_motion->full : none}, context.step.potential);
  if (linear.x.size() == 0) return continued;
  linear.solve.add_work(continued.solve);
  return linear;
}

// Moves along linear trajectories. The free vertices follow the displacement of lowest potential,
// truncated to be feasible, or rest. The result has no x if the trajectories are blocked.
DirichletContinuation::Result PrescribedMotionFollower::move_linearly(const VecX& x, const VecX& targets, const std::vector<VecX>& displacements, StepPotential& potential) {
  const VecX prescribed = targets - x;
  VecX q, free = VecX::Zero(x.size());  // free: displacement of the free vertices
  DirichletContinuation::Result best{{}, VecX(), ""};
  double lowest = std::numeric_limits<double>::infinity();
  const auto feasible_fraction = [&](double fraction) {
    const VecX p = prescribed + fraction * free;
    const double t = steps_.largest(x, p);
    if (t < 1) return t;
    world_.dofs.gather(x + p, q);
    potential.move_to(q);
    if (potential.value() < lowest) {
      lowest = potential.value();
      best.x = targets;
      world_.dofs.scatter(q, best.x);
    }
    return t;
  };
  for (const VecX& displacement : displacements) {
    if (displacement.isZero()) continue;
    world_.dofs.scatter(displacement, free);
    const double t = feasible_fraction(1);
    if (t > 0 && t < 1) feasible_fraction(usable_fraction * t);
  }
  feasible_fraction(0);
  return best;
}

DirichletContinuation::Result PrescribedMotionFollower::run_continuation(const VecX& x, const VecX& targets, const Context& context) {
  if (!continuation_) continuation_.emplace(world_, like_, clock_, steps_);
  if (context.check) context.check->begin(context.step.state.step + 1, "the Dirichlet continuation of the prescribed motion");
  return continuation_->run(x, targets, context.step.prediction, context.observer);
}

}  // namespace tack
