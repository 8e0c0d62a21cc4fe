#include "framework/stepping/script_follower.hpp"

#include <limits>

#include "framework/stepping/held_vertices.hpp"

namespace tack {
namespace {

// Of the way that free vertices may move along with scripted ones: the last bit would leave no gap.
constexpr double most_of_it = 0.9;

}  // namespace

ScriptWalk::Result ScriptFollower::follow(const Step& step, IterateCheck* check,
                                          const MinimizerProblem::Observer& observer) {
  const State& state = step.state;
  const TimeIntegrator::Prediction& prediction = step.prediction;
  const int parts = step.held.straight_parts(state.time, step.h);
  VecX along = VecX::Zero(state.x.size()), q;
  if (prediction.inertia) {
    world_.dofs.gather(step.h / parts * (state.v + step.h * state.a), q);
    world_.dofs.scatter(q, along);
  }
  const Way way{step, check, observer};
  ScriptWalk::Result result{{}, state.x, ""};
  for (int i = 1; i <= parts; ++i) {
    VecX places = result.x;
    step.held.place(state.time + step.h * i / parts, places);
    step.potential.begin_step(places, prediction.x, prediction.scales(), prediction.inertia);
    const MinimizerResult before = result.solve;
    result = move(result.x, places, along, way);
    result.solve.add_work(before);
    if (!result.failure.empty() || result.solve.status != MinimizerStatus::converged) break;
  }
  return result;
}

// From x to where the scripted vertices are at their places: the straight way, with the free ones moving
// along as far as they may, or not at all, whichever is better; a walk if that is blocked.
ScriptWalk::Result ScriptFollower::move(const VecX& x, const VecX& places, const VecX& along, const Way& way) {
  StepPotential& potential = way.step.potential;
  const VecX scripted = places - x;
  VecX q;
  ScriptWalk::Result best{{}, VecX(), ""};
  double lowest = std::numeric_limits<double>::infinity();
  const auto reach_of = [&](double part) {
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
  const bool predicted = !along.isZero();
  const double t = predicted ? reach_of(1) : 0;
  if (t > 0 && t < 1) reach_of(most_of_it * t);
  reach_of(0);
  if (best.x.size() > 0) return best;
  if (!walk_) walk_.emplace(world_, like_, clock_, steps_);
  if (way.check) way.check->begin(way.step.state.step + 1, "the walk of what the script moves");
  return walk_->run(x, places, way.step.prediction, way.observer);
}

}  // namespace tack
