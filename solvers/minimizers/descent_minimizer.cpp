#include "solvers/minimizers/descent_minimizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/config/field.hpp"
#include "framework/core/deadline.hpp"
#include "geometry/interrupt.hpp"
#include "solvers/minimizers/tell_iteration.hpp"

namespace tack {
namespace {

constexpr double steep = 0.25;  // part of the first slope that is left where going on is worth it
constexpr double longest = 4;   // further step, in units of the way so far
constexpr int most_further = 10;
constexpr double least_further = 0.1;
// A Hessian is too stiff where a step that is at least so long decreases the objective so many times as much as predicted.
constexpr double longish = 0.3, too_much = 1.25;
// Bent steps: of what a straight one gains, the part that it may lose to strains; the shortest; of a feasible length, what
// is tried next; Armijo's condition.
constexpr double little_loss = 1e-6, shortest_bent = 1e-4, shorter = 0.9, sufficient = 1e-4;
constexpr double almost_whole = 0.9;  // a step that is shorter was cut
constexpr double descent = 0.1;  // part of a Newton direction's slope that one conjugate to the last step must keep

}  // namespace

void DescentMinimizer::fields(Fields& f) {
  Minimizer::fields(f);
  f.component("line_search", line_search_, "step length");
}

MinimizerResult DescentMinimizer::minimize(const MinimizerProblem& problem, VecX& q) {
  MinimizerResult result;
  try {
    return descend(problem, q, result);
  } catch (const OutOfTime&) {
    result.status = MinimizerStatus::time_limit;
    return result;
  }
}

MinimizerResult DescentMinimizer::descend(const MinimizerProblem& problem, VecX& q, MinimizerResult& result) {
  const auto end = [&](MinimizerStatus status) {
    result.status = status;
    return result;
  };
  Objective& objective = problem.objective;
  objective.move_to(q);
  gradient_before_.resize(0);
  too_stiff_ = cut_ = unbalanced_ = false;
  judge_.begin();
  stagnation_.begin();
  begin(problem, result);
  const TellIteration tell(problem);
  VecX p;
  while (result.iterations < max_iterations_) {
    if (interrupt_requested) return end(MinimizerStatus::interrupted);
    if (!newton_like()) {
      if (!objective.gradient().allFinite()) return end(MinimizerStatus::not_finite);
      if (judge_.converged(problem, result)) return end(MinimizerStatus::converged);
    }
    const MinimizerStatus found = direction(problem, p, result);
    if (!objective.gradient().allFinite()) return end(MinimizerStatus::not_finite);
    if (found != MinimizerStatus::converged) return end(found);
    ++result.iterations;
    if (newton_like()) result.residual = newton_norm(problem, p, result);
    const bool last = newton_like() && result.residual <= 1;
    // Directions that would end it are left as they are. Where forces did not balance after one, they are accelerated like all
    // others, but within the tolerance: what is near its end may not be carried past what holds it.
    accelerated_ = newton_like() && (!last || unbalanced_);
    if (accelerated_) conjugate(problem, q, p, last);
    room_ = last ? 1 / problem.stopping_norm(p, objective.gradient()) : std::numeric_limits<double>::infinity();
    const VecX before = last ? q : VecX();
    const MinimizerStatus moved = advance(problem, p, q, result);
    tell(result);
    // Below the tolerance the point is accepted as it is, whether or not the last step helped, if forces balance.
    if (last && balanced(problem, result)) return end(MinimizerStatus::converged);
    unbalanced_ = last;
    if (!last) {
      stagnation_.begin();
    } else if (moved == MinimizerStatus::converged && !balance_given()) {  // what a scene states is met
      const double way = problem.stopping_norm(q - before, objective.gradient());
      if (stagnation_.stagnates(way, problem.imbalance(objective.gradient()))) return end(MinimizerStatus::converged);
    }
    if (moved == MinimizerStatus::line_search_failed && restart(problem)) continue;
    if (moved != MinimizerStatus::converged) return end(moved);
  }
  return end(MinimizerStatus::iteration_limit);
}

// p <- p + beta s, s the last step, so that p . (change of the gradient along s) = 0: the exact Hessian's curvature
// along s, which a projection may have missed. Where the model holds, beta vanishes. Not below 0, as after a restart.
// Within the tolerance, if that is asked for.
void DescentMinimizer::conjugate(const MinimizerProblem& problem, const VecX& q, VecX& p, bool within) {
  const VecX& gradient = problem.objective.gradient();
  if (cut_) {  // what a part of a step did says little of the metric, and directions that grew would be cut again
    gradient_before_.resize(0);
    too_stiff_ = false;
  }
  if (too_stiff_ && gradient_before_.size() == gradient.size()) {
    const VecX s = q - q_before_, change = gradient - gradient_before_;
    const double curvature = s.dot(change), beta = curvature > 0 ? -p.dot(change) / curvature : 0;
    const bool short_enough = std::abs(beta) * s.norm() < longest * (p.norm() + s.norm());
    const VecX to = p + beta * s;
    if (beta > 0 && short_enough && to.dot(gradient) < descent * p.dot(gradient) &&
        (!within || problem.stopping_norm(to, gradient) <= 1))
      p = to;
  }
  gradient_before_ = gradient;
  q_before_ = q;
}

// Moves q along the feasible part of p.
MinimizerStatus DescentMinimizer::advance(const MinimizerProblem& problem, const VecX& p, VecX& q,
                                          MinimizerResult& result) {
  Objective& objective = problem.objective;
  cut_ = false;
  if (problem.bend && newton_like() && advance_bent(problem, p, q, result)) return MinimizerStatus::converged;
  const double t_max = problem.feasible_step(q, p);
  if (!(t_max > 1e-12)) return MinimizerStatus::blocked;
  const PhaseScope scope(problem.clock, Phase::line_search);
  const double slope = objective.gradient().dot(p);
  if (!(slope < 0)) return MinimizerStatus::line_search_failed;
  const double before = objective.value();
  const LineSearchResult found = line_search_->search(objective, q, p, slope, t_max);
  result.line_search_evaluations += found.evaluations;
  if (!found.found) {
    objective.move_to(q);
    return MinimizerStatus::line_search_failed;
  }
  q += found.step * p;
  const double decrease = before - objective.value(), predicted = -(found.step - found.step * found.step / 2) * slope;
  too_stiff_ |= found.step > longish && decrease > too_much * predicted && decrease > 2 * objective.value_noise();
  cut_ = found.step < almost_whole;
  stepped(problem, {p, found.step, t_max, found.evaluations, slope, decrease});
  if (accelerated_ && found.step == 1) extend(problem, p, slope, before, q, result);
  return MinimizerStatus::converged;
}

// Moves q straight to the end of t p as it is bent, where that is feasible and descends; t shrinks until it does. False, and
// nothing moved, where p need not be bent, or nothing is found.
bool DescentMinimizer::advance_bent(const MinimizerProblem& problem, const VecX& p, VecX& q, MinimizerResult& result) {
  Objective& objective = problem.objective;
  const double slope = objective.gradient().dot(p), before = objective.value(), noise = objective.value_noise();
  int evaluations = 0;
  double feasible = 1;
  for (double t = 1; t > shortest_bent && -t * slope > 2 * noise;) {
    VecX way = t * p;
    if (!problem.bend(q, way, t == 1 ? -little_loss * slope : 0)) break;
    if (const double part = problem.feasible_step(q, way); part < 1) {
      t *= feasible < 1 ? shorter * part : part;
      feasible = t;
      continue;
    }
    const PhaseScope scope(problem.clock, Phase::line_search);
    objective.move_to(q + way);
    const double value = objective.value();
    ++evaluations;
    ++result.line_search_evaluations;
    if (descends(before, value, std::max(noise, objective.value_noise()), t, slope, sufficient)) {
      q += way;
      stepped(problem, {p, t, feasible, evaluations, slope, before - value});
      return true;
    }
    t /= 2;
  }
  if (evaluations > 0) objective.move_to(q);
  return false;
}

// Negative curvatures that a projection has taken out of stencils make Newton steps short where others would
// outweigh them: at the end of p the objective still falls. Then further steps along it, as long as its slope and
// the last decrease say, are worth more than a new direction. As long as they decrease the objective, and none
// is blocked.
void DescentMinimizer::extend(const MinimizerProblem& problem, const VecX& p, double first_slope, double before,
                              VecX& q, MinimizerResult& result) {
  Objective& objective = problem.objective;
  double value = objective.value(), slope = first_slope, length = 1, way = 1;
  for (int i = 0; i < most_further; ++i) {
    const double change = value - before, next = 2 * change / length - slope;  // of a quadratic
    if (!(next < steep * first_slope) || !(-change > 2 * objective.value_noise())) return;
    const double bend = (next - slope) / length;
    length = bend > 0 ? std::min(-next / bend, longest * way) : longest * way;
    if (room_ - way < least_further) return;
    length = std::min(length, room_ - way);
    const VecX step = length * p;
    if (problem.feasible_step(q, step) < 1) return;
    objective.move_to(q + step);
    ++result.line_search_evaluations;
    const double further = objective.value();
    if (!(further < value - objective.value_noise())) {
      objective.move_to(q);
      return;
    }
    q += step;
    way += length;
    slope = next;
    before = std::exchange(value, further);
  }
}

}  // namespace tack
