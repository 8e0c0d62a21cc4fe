#include "framework/stepping/prescribed_motion.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "framework/config/field.hpp"
#include "framework/stepping/affine_controls.hpp"
#include "framework/stepping/fixed_vertices.hpp"
#include "framework/stepping/obstacle.hpp"
#include "framework/stepping/penalty_rule.hpp"
#include "framework/stepping/predicted_motion.hpp"
#include "framework/stepping/step_retraction.hpp"

namespace tack {
namespace {

constexpr int debonding_halvings = 6;  // of a step that debonds stencils: a peak is passed within a 64th of it

}  // namespace

void MotionPenalty::fields(Fields& f) {
  f.number("stiffness", stiffness, units::none,
           "first penalty stiffness of vertices with prescribed motion that meet an obstacle, over the mean diagonal of the Hessian of a step at these vertices").positive();
  f.number("remainder", remainder, units::none,
           "fraction of their displacement in a step that these vertices may have left when they are set to their targets").range(1e-6, 0.5);
}

PrescribedMotionSolver::Result PrescribedMotionSolver::solve(const Step& step, IterateCheck* check, const MinimizerProblem::Observer& observer) {
  const State& state = step.state;
  const TimeIntegrator::Prediction& prediction = step.prediction;
  const int substeps = step.fixed.rotation_substeps(state.time, step.h);
  FreeMotion free;
  if (prediction.inertia) {
    world_.dofs.gather(step.h / substeps * (state.v + step.h * state.a), free.full);
    world_.dofs.gather(step.h / substeps * state.v, free.uniform);
  } else {
    free.full = free.uniform = VecX::Zero(world_.dofs.size());
  }
  const Context context{step, check, observer};
  Result result{{}, state.x, ""};
  for (int i = 1; i <= substeps; ++i) {
    VecX targets = result.x;
    step.fixed.set_positions(state.time + step.h * i / substeps, targets);
    step.potential.begin_step(targets, prediction.x, prediction.scales(), prediction.inertia);
    if (i > 1) world_.participants.move_to(result.x);
    const MinimizerResult before = result.solve;
    result = move(result.x, targets, free, context);
    result.solve.add_work(before);
    if (!result.failure.empty() || result.solve.status != MinimizerStatus::converged) break;
  }
  return result;
}

// Moves from x to the targets: along linear trajectories, or by the augmented Lagrangian if these are
// blocked or debond stencils. If the latter fails where stencils debond, linear trajectories are used.
PrescribedMotionSolver::Result PrescribedMotionSolver::move(const VecX& x, const VecX& targets, const FreeMotion& free, const Context& context) {
  const PredictedMotion predicted = predicted_motion(world_, x, targets - x, free.full, free.uniform);
  if (!predicted.debonds) {
    Result linear = move_linearly(x, targets, predicted.displacements, context.step.potential);
    if (linear.x.size() > 0) return linear;
    return push(x, targets, context);
  }
  Result pushed = push(x, targets, context);
  if (pushed.failure.empty()) return pushed;
  Result linear = move_linearly(x, targets, {free.full}, context.step.potential);
  if (linear.x.size() == 0) return pushed;
  linear.solve.add_work(pushed.solve);
  return linear;
}

// Moves along linear trajectories. The free vertices follow the displacement of lowest potential,
// truncated to be feasible, or rest. The result has no x if the trajectories are blocked.
PrescribedMotionSolver::Result PrescribedMotionSolver::move_linearly(const VecX& x, const VecX& targets, const std::vector<VecX>& displacements, StepPotential& potential) {
  const VecX prescribed = targets - x;
  VecX q, free = VecX::Zero(x.size());  // free: displacement of the free vertices
  Result best{{}, VecX(), ""};
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

// Moves by the augmented Lagrangian.
PrescribedMotionSolver::Result PrescribedMotionSolver::push(const VecX& x, const VecX& targets, const Context& context) {
  const TimeIntegrator::Prediction& prediction = context.step.prediction;
  if (context.check) context.check->begin(context.step.state.step + 1, "the prescribed motion");
  set_unknowns(x, targets, context.step);
  VecX goal = prediction.x;  // of free vertices the prediction, of V t + lambda / K
  for (const int v : moving_) vertex(goal, v) = vertex(targets, v);
  Result result{{}, x, ""};
  PenaltyRule rule(first_penalty(x, prediction), distance(x, targets), penalty_.remainder);
  const auto norm = [&](const VecX& p) { return rule.norm(distance(potential_->configuration(), targets), own_step(p)); };
  while (!rule.blocked()) {
    potential_->set_mass(masses(rule.stiffness(), prediction.inertia));
    potential_->begin_step(result.x, goal, prediction.scales(), true);
    minimize(result, norm, context.observer);
    if (result.solve.status == MinimizerStatus::interrupted || result.solve.status == MinimizerStatus::time_limit) return result;
    if (result.solve.status == MinimizerStatus::iteration_limit) break;
    const double now = distance(result.x, targets);
    if (rule.reached(now)) {
      if (set_targets(targets, result.x)) {
        result.solve.status = MinimizerStatus::converged;
        return result;
      }
      rule.come_closer(now);
    }
    const double growth = rule.next(now);
    for (const int v : moving_) {
      Vec3 multiplier = vertex(goal, v) - vertex(targets, v);  // over K
      if (growth > 1) multiplier /= growth;
      else multiplier += vertex(targets, v) - vertex(result.x, v);
      vertex(goal, v) = vertex(targets, v) + multiplier;
    }
  }
  result.failure = failure(result.x, targets);
  return result;
}

// Sets V, its dependences and the unknowns. All vertices of a rigid motion belong to V if one of them
// moves, those on its axis too.
void PrescribedMotionSolver::set_unknowns(const VecX& x, const VecX& targets, const Step& step) {
  const DofMap& dofs = world_.dofs;
  std::vector<char> prescribed(dofs.vertex_count()), moves(dofs.vertex_count());
  for (int v = 0; v < dofs.vertex_count(); ++v) prescribed[v] = !dofs.moves(v);
  for (const DofMap::PartlyFixedBlock& h : dofs.partly_fixed_blocks()) prescribed[dofs.vertex_of_block(h.block)] = 1;
  for (const int v : dofs.dependents()) prescribed[v] = 0;
  for (int v = 0; v < dofs.vertex_count(); ++v) moves[v] = prescribed[v] && vertex(x, v) != vertex(targets, v);
  const std::vector<const PrescribedMotion::Assignment*> rigid = rigid_motions(step);
  for (const PrescribedMotion::Assignment* motion : rigid)
    if (std::any_of(motion->vertices.begin(), motion->vertices.end(), [&](int v) { return moves[v] != 0; }))
      for (const int v : motion->vertices) moves[v] = prescribed[v];
  std::vector<int> moving;
  for (int v = 0; v < dofs.vertex_count(); ++v)
    if (moves[v]) moving.push_back(v);
  const bool known = potential_ && moving == moving_;
  moving_ = std::move(moving);
  Dependences dependences = rigid_dependences(rigid, x, targets);
  if (known && std::equal(dependences.begin(), dependences.end(), dependences_.begin(), dependences_.end(),
                          [](const Dependence& a, const Dependence& b) { return a.vertex == b.vertex && a.on == b.on; }))
    return;
  dependences_ = std::move(dependences);
  std::vector<char> unknown(dofs.vertex_count());
  share_.assign(dofs.vertex_count(), 0);
  for (int v = 0; v < dofs.vertex_count(); ++v) unknown[v] = dofs.moves(v);
  for (const int v : moving_) unknown[v] = 1, share_[v] = 1;
  for (const Dependence& d : dependences_) {
    if (share_[d.vertex] == 0) continue;
    share_[d.vertex] = 0;
    for (const auto& [on, weight] : d.on) share_[on] += 1.0 / static_cast<double>(d.on.size());
  }
  Dependences all = dofs.dependences();
  all.insert(all.end(), dependences_.begin(), dependences_.end());
  dofs_ = DofMap(unknown, all, fixed_directions());
  potential_.emplace(world_, clock_, world_.terms, dofs_, masses(1, true));
}

// Returns the rigid motions that fix vertices in the step.
std::vector<const PrescribedMotion::Assignment*> PrescribedMotionSolver::rigid_motions(const Step& step) const {
  std::vector<const PrescribedMotion::Assignment*> rigid;
  const std::vector<char> active = world_.prescribed_motion.active(step.state.time + step.h / 2);
  for (size_t i = 0; i < active.size(); ++i)
    if (const PrescribedMotion::Assignment& motion = world_.prescribed_motion.assignments()[i]; active[i] && !motion.motion->partial() && motion.motion->rigid())
      rigid.push_back(&motion);
  return rigid;
}

// Returns the dependences of vertices of rigid motions on control vertices. Their weights are those
// at rest if the motion is rigid from there on, so that they are the same in all steps.
Dependences PrescribedMotionSolver::rigid_dependences(const std::vector<const PrescribedMotion::Assignment*>& rigid, const VecX& x, const VecX& targets) const {
  Dependences all;
  for (const PrescribedMotion::Assignment* motion : rigid) {
    std::vector<int> own;
    std::set_intersection(motion->vertices.begin(), motion->vertices.end(), moving_.begin(), moving_.end(), std::back_inserter(own));
    if (own.size() < 2) continue;
    for (const VecX* reference : {static_cast<const VecX*>(&world_.rest), &x}) {
      const Dependences found = affine_dependences(own, *reference);
      if (!hold(found, x) || !hold(found, targets)) continue;
      all.insert(all.end(), found.begin(), found.end());
      break;
    }
  }
  return all;
}

// Returns the fixed directions of the unknowns: those of vertices that do not move, e.g. rollers. V is
// free, except in directions that are fixed for the whole run.
std::vector<FixedDirections> PrescribedMotionSolver::fixed_directions() const {
  std::vector<FixedDirections> fixed;
  const auto moves = [&](int v) { return std::binary_search(moving_.begin(), moving_.end(), v); };
  for (const DofMap::PartlyFixedBlock& h : world_.dofs.partly_fixed_blocks())
    if (const int v = world_.dofs.vertex_of_block(h.block); !moves(v)) fixed.push_back({v, h.projection, h.scalar});
  for (const FixedDirections& always : world_.prescribed_motion.always_fixed())
    if (moves(always.vertex)) fixed.push_back(always);
  return fixed;
}

VecX PrescribedMotionSolver::masses(double stiffness, bool inertia) const {
  VecX mass = inertia ? world_.mass : VecX::Zero(world_.mass.size()).eval();
  for (const int v : moving_) mass(v) = stiffness * share_[v];
  return mass;
}

// Returns the first K: a multiple of the mean diagonal of the Hessian at V without the penalty, which is the stiffness of what V touches
// and belongs to, but at least the mean diagonal of all unknowns. If V touches nothing at the start of the step: that multiple of the latter.
double PrescribedMotionSolver::first_penalty(const VecX& x, const TimeIntegrator::Prediction& prediction) {
  VecX q;
  dofs_.gather(x, q);
  potential_->set_mass(masses(0, prediction.inertia));
  potential_->begin_step(x, prediction.x, prediction.scales(), true);
  potential_->move_to(q);
  const BlockMatrix& matrix = potential_->hessian({Projection::clamp});
  double touched = 0, shares = 0, sum = 0;
  for (const int v : moving_) {
    if (!dofs_.owns(v)) continue;
    touched += matrix.block(matrix.column_start[dofs_.block(v)]).trace();
    shares += 3 * share_[v];
  }
  for (int c = 0; c < matrix.columns(); ++c) sum += matrix.block(matrix.column_start[c]).trace();
  if (!(sum > 0)) return penalty_.stiffness;  // any K, without resistance
  const double mean = sum / matrix.size();
  return touched > 0 ? std::max(penalty_.stiffness * touched / shares, mean) : penalty_.stiffness * mean;
}

double PrescribedMotionSolver::distance(const VecX& x, const VecX& targets) const {
  double largest = 0;
  for (const int v : moving_) largest = std::max(largest, (vertex(x, v) - vertex(targets, v)).norm());
  return largest;
}

// Returns the largest displacement of an unknown of V under the direction p [m].
double PrescribedMotionSolver::own_step(const VecX& p) const {
  double largest = 0;
  for (const int v : moving_)
    if (dofs_.owns(v)) largest = std::max(largest, p.segment<3>(3 * dofs_.block(v)).norm());
  return largest;
}

// Returns the fraction of a step to take: a part of the feasible one if it is cut, shorter if stencils
// debond.
double PrescribedMotionSolver::feasible_step(const VecX& q, const VecX& p) {
  const double feasible = steps_.largest_requested(*potential_, q, p);
  double t = feasible < 1 ? usable_fraction * feasible : 1;
  VecX x = potential_->configuration(), displacement = VecX::Zero(x.size());
  dofs_.scatter(q, x);
  if (x != potential_->configuration()) return t;  // the terms are elsewhere
  dofs_.scatter(p, displacement);
  for (int i = 0; i < debonding_halvings && anything_debonds(world_, x, x + t * displacement); ++i) t /= 2;
  return t;
}

void PrescribedMotionSolver::minimize(Result& result, const std::function<double(const VecX& p)>& norm, const MinimizerProblem::Observer& observer) {
  if (!minimizer_) minimizer_ = like_.fresh();
  MinimizerProblem problem{*potential_, {}, [&](const VecX& p, const VecX&) { return norm(p); }, clock_};
  steps_.set_feasibility(*potential_, problem);
  problem.feasible_step = [&](const VecX& q, const VecX& p) { return feasible_step(q, p); };
  const MinimizerResult before = result.solve;
  if (observer)
    problem.observer = [&](int iteration, double residual, double value, double seconds) { observer(before.iterations + iteration, residual, value, seconds); };
  set_retraction(world_, *potential_, problem);
  VecX q;
  dofs_.gather(result.x, q);
  result.solve = minimizer_->minimize(problem, q);
  result.solve.add_work(before);
  dofs_.scatter(q, result.x);
}

// Moves V from x to its exact targets. Returns false if that is blocked or debonds stencils.
bool PrescribedMotionSolver::set_targets(const VecX& targets, VecX& x) const {
  VecX last = VecX::Zero(x.size());
  for (const int v : moving_) vertex(last, v) = vertex(targets, v) - vertex(x, v);
  world_.dofs.update_dependents(last);
  if (steps_.largest_requested(x, last) < 1) return false;
  world_.participants.move_to(x);
  if (anything_debonds(world_, x, x + last)) return false;
  for (const int v : moving_) vertex(x, v) = vertex(targets, v);
  world_.dofs.update_dependents(x);
  return true;
}

std::string PrescribedMotionSolver::failure(const VecX& x, const VecX& targets) const {
  const auto left = [&](int v) { return (vertex(x, v) - vertex(targets, v)).norm(); };
  const int farthest = *std::max_element(moving_.begin(), moving_.end(), [&](int v, int w) { return left(v) < left(w); });
  return describe_obstacle(world_, x, farthest, left(farthest));
}

}  // namespace tack
