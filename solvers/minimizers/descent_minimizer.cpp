#include "solvers/minimizers/descent_minimizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/config/field.hpp"
#include "framework/core/deadline.hpp"
#include "geometry/interrupt.hpp"
#include "solvers/minimizers/iteration_notifier.hpp"

namespace tack {
namespace {

constexpr double steep = 0.25;  // fraction of the first slope above which a step is extrapolated
constexpr double longest = 4;   // limit of one extrapolation, in units of the length so far
constexpr int most_further = 10;
constexpr double least_further = 0.1;
// A Hessian is too stiff if a step of at least `longish` decreases the objective by `too_much`
// times the predicted decrease.
constexpr double longish = 0.3, too_much = 1.25;
// Retracted steps. tolerated_loss: fraction of the straight step's gain that strains may take;
// shortest_bent: shortest length; shorter: factor on a feasible length; sufficient: Armijo's
// constant.
constexpr double tolerated_loss = 1e-6, shortest_bent = 1e-4, shorter = 0.9, sufficient = 1e-4;
constexpr double almost_whole = 0.9;  // step lengths below it were truncated
// Fraction of the Newton slope that a conjugate direction must keep.
constexpr double descent = 0.1;

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
  too_stiff_ = truncated_ = unbalanced_ = false;
  judge_.begin();
  stagnation_.begin();
  begin(problem, result);
  const IterationNotifier notify(problem);
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
    // Directions that would end the minimisation stay as they are. If forces were out of balance
    // after such a direction, the next ones are accelerated like all others, but within the
    // tolerance, so that a body near its equilibrium is not carried past it.
    accelerated_ = newton_like() && (!last || unbalanced_);
    if (accelerated_) conjugate(problem, q, p, last);
    feasible_length_ = last ? 1 / problem.stopping_norm(p, objective.gradient()) : std::numeric_limits<double>::infinity();
    const VecX before = last ? q : VecX();
    const MinimizerStatus moved = advance(problem, p, q, result);
    notify(result);
    // Below the tolerance the point is accepted if forces balance, whether or not the last step
    // decreased the objective.
    if (last && balanced(problem, result)) return end(MinimizerStatus::converged);
    unbalanced_ = last;
    if (!last) {
      stagnation_.begin();
    } else if (moved == MinimizerStatus::converged && !balance_given()) {  // what a scene states is met
      const double step_norm = problem.stopping_norm(q - before, objective.gradient());
      if (stagnation_.stagnates(step_norm, problem.force_residual(objective.gradient()))) return end(MinimizerStatus::converged);
    }
    if (moved == MinimizerStatus::line_search_failed && nearly_newton() && at_equilibrium(problem, p, result)) return end(MinimizerStatus::converged);
    if (moved == MinimizerStatus::line_search_failed && restart(problem)) continue;
    if (moved != MinimizerStatus::converged) return end(moved);
  }
  return end(MinimizerStatus::iteration_limit);
}

// Returns whether a direction along which nothing decreases the objective is within the tolerance,
// and forces balance: an equilibrium whose forces are round-off.
bool DescentMinimizer::at_equilibrium(const MinimizerProblem& problem, const VecX& p, MinimizerResult& result) const {
  result.residual = problem.stopping_norm(p, problem.objective.gradient());
  return result.residual <= 1 && balanced(problem, result);
}

// p <- p + beta s, with the last step s, so that p . (change of the gradient along s) = 0. This
// adds the exact Hessian's curvature along s, which a projection may have removed; beta vanishes
// where the model is exact. beta >= 0, as in a restart. within: keeps p within the tolerance.
void DescentMinimizer::conjugate(const MinimizerProblem& problem, const VecX& q, VecX& p, bool within) {
  const VecX& gradient = problem.objective.gradient();
  // a truncated step says little of the metric, and longer directions would be truncated again
  if (truncated_) {
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
  truncated_ = false;
  if (problem.retract && newton_like() && advance_with_retraction(problem, p, q, result)) return MinimizerStatus::converged;
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
  truncated_ = found.step < almost_whole;
  stepped(problem, {p, found.step, t_max, found.evaluations, slope, decrease});
  if (accelerated_ && found.step == 1) extend(problem, p, slope, before, q, result);
  return MinimizerStatus::converged;
}

// Moves q to the end of the retracted step t p, with the largest t that is feasible and descends.
// Returns false, with q unchanged, if p needs no retraction or no t is found.
bool DescentMinimizer::advance_with_retraction(const MinimizerProblem& problem, const VecX& p, VecX& q, MinimizerResult& result) {
  Objective& objective = problem.objective;
  const double slope = objective.gradient().dot(p), before = objective.value(), noise = objective.value_noise();
  int evaluations = 0;
  double feasible = 1;
  for (double t = 1; t > shortest_bent && -t * slope > 2 * noise;) {
    VecX step = t * p;
    if (!problem.retract(q, step, t == 1 ? -tolerated_loss * slope : 0)) break;
    if (const double allowed = problem.feasible_step(q, step); allowed < 1) {
      t *= feasible < 1 ? shorter * allowed : allowed;
      feasible = t;
      continue;
    }
    const PhaseScope scope(problem.clock, Phase::line_search);
    objective.move_to(q + step);
    const double value = objective.value();
    ++evaluations;
    ++result.line_search_evaluations;
    if (descends(before, value, std::max(noise, objective.value_noise()), t, slope, sufficient)) {
      q += step;
      stepped(problem, {p, t, feasible, evaluations, slope, before - value});
      return true;
    }
    t /= 2;
  }
  if (evaluations > 0) objective.move_to(q);
  return false;
}

// Extrapolates the step. Negative curvatures that projection removed from stencils make Newton
// steps too short: at the end of p the objective still falls. Further steps along p, sized by its
// slope and the last decrease, are cheaper than a new direction. Stops when a step does not
// decrease the objective or is blocked.
void DescentMinimizer::extend(const MinimizerProblem& problem, const VecX& p, double first_slope, double before,
                              VecX& q, MinimizerResult& result) {
  Objective& objective = problem.objective;
  double value = objective.value(), slope = first_slope, length = 1, travelled = 1;
  for (int i = 0; i < most_further; ++i) {
    const double change = value - before, next = 2 * change / length - slope;  // of a quadratic
    if (!(next < steep * first_slope) || !(-change > 2 * objective.value_noise())) return;
    const double bend = (next - slope) / length;
    length = bend > 0 ? std::min(-next / bend, longest * travelled) : longest * travelled;
    if (feasible_length_ - travelled < least_further) return;
    length = std::min(length, feasible_length_ - travelled);
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
    travelled += length;
    slope = next;
    before = std::exchange(value, further);
  }
}

}  // namespace tack
