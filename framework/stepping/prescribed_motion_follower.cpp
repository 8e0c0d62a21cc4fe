#include "framework/stepping/prescribed_motion_follower.hpp"

#include <limits>

#include "framework/stepping/fixed_vertices.hpp"
#include "framework/stepping/predicted_motion.hpp"

namespace tack {
namespace {

// Largest fraction of the feasible step of free vertices that is used: the rest would leave no gap.
constexpr double most_of_it = 0.9;

}  // namespace

DirichletContinuation::Result PrescribedMotionFollower::follow(const Step& step, IterateCheck* check,
                                          const MinimizerProblem::Observer& observer) {
  const State& state = step.state;
  const TimeIntegrator::Prediction& prediction = step.prediction;
  const int parts = step.fixed.rotation_substeps(state.time, step.h);
  Along along;
  if (prediction.inertia) {
    world_.dofs.gather(step.h / parts * (state.v + step.h * state.a), along.full);
    world_.dofs.gather(step.h / parts * state.v, along.drift);
  }
  const Way way{step, check, observer};
  DirichletContinuation::Result result{{}, state.x, ""};
  for (int i = 1; i <= parts; ++i) {
    VecX places = result.x;
    step.fixed.set_positions(state.time + step.h * i / parts, places);
    step.potential.begin_step(places, prediction.x, prediction.scales(), prediction.inertia);
    if (i > 1) world_.participants.move_to(result.x);
    const MinimizerResult before = result.solve;
    result = move(result.x, places, prediction.inertia ? &along : nullptr, way);
    result.solve.add_work(before);
    if (!result.failure.empty() || result.solve.status != MinimizerStatus::converged) break;
  }
  return result;
}

// Moves from x to the target positions of the prescribed vertices. The trajectory is linear, with
// the free vertices moving as predicted. If that is blocked, or takes bonds or adhesion past their
// peaks, it is a Dirichlet continuation. If these let go in the continuation too, they are being
// torn off, and the trajectory may be linear.
DirichletContinuation::Result PrescribedMotionFollower::move(const VecX& x, const VecX& places, const Along* along, const Way& way) {
  const VecX none = VecX::Zero(world_.dofs.size());
  const PredictedMotion predicted = predicted_motion(world_, x, places - x, along ? along->full : none, along ? along->drift : none);
  if (!predicted.debonds) {
    const DirichletContinuation::Result straight = go_straight(x, places, predicted.displacements, way.step.potential);
    return straight.x.size() > 0 ? straight : walk(x, places, way);
  }
  const DirichletContinuation::Result walked = walk(x, places, way);
  if (walked.failure.empty()) return walked;
  DirichletContinuation::Result straight = go_straight(x, places, {along ? along->full : none}, way.step.potential);
  if (straight.x.size() == 0) return walked;
  straight.solve.add_work(walked.solve);
  return straight;
}

// Moves along linear trajectories, with the free vertices on the best of these paths as far as is
// feasible, or at rest. The result has no x if that is blocked.
DirichletContinuation::Result PrescribedMotionFollower::go_straight(const VecX& x, const VecX& places, const std::vector<VecX>& ways, StepPotential& potential) {
  const VecX scripted = places - x;
  VecX q;
  DirichletContinuation::Result best{{}, VecX(), ""};
  double lowest = std::numeric_limits<double>::infinity();
  const auto reach_of = [&](const VecX& along, double part) {
    const VecX p = scripted + part * along;
    const double t = steps_.largest(x, p);
    if (t < 1) return t;
    world_.dofs.gather(x + p, q);
    potential.move_to(q);
    if (potential.value() < lowest) {
      lowest = potential.value();
      best.x = places;
      world_.dofs.scatter(q, best.x);
    }
    return t;
  };
  VecX along = VecX::Zero(x.size());
  for (const VecX& way : ways) {
    if (way.isZero()) continue;
    world_.dofs.scatter(way, along);
    const double t = reach_of(along, 1);
    if (t > 0 && t < 1) reach_of(along, most_of_it * t);
  }
  reach_of(along, 0);
  return best;
}

DirichletContinuation::Result PrescribedMotionFollower::walk(const VecX& x, const VecX& places, const Way& way) {
  if (!walk_) walk_.emplace(world_, like_, clock_, steps_);
  if (way.check) way.check->begin(way.step.state.step + 1, "the walk of what the script moves");
  return walk_->run(x, places, way.step.prediction, way.observer);
}

}  // namespace tack
