#include "solvers/minimizers/descent_minimizer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

#include "framework/config/field.hpp"
#include "framework/core/deadline.hpp"
#include "framework/core/minimizer_failure.hpp"
#include "geometry/interrupt.hpp"
#include "solvers/minimizers/iteration_notifier.hpp"

namespace tack {
namespace {

// Throws std::length_error unless a direction has an entry per unknown.
void check_size(const VecX& p, const VecX& q) {
  if (p.size() != q.size())
    throw std::length_error(fmt::format(
        "its direction has {} entries, and the problem has {} unknowns", p.size(), q.size()));
}

// Returns whether the objective decreases along p, or g is so small that no decrease, of the order
// of g^2, is a normal number.
bool descends(const VecX& g, const VecX& p) {
  return g.squaredNorm() < std::numeric_limits<double>::min() || g.dot(p) < 0;
}

}  // namespace

void DescentMinimizer::fields(Fields& f) {
  Minimizer::fields(f);
  f.component("line_search", line_search_, "step length");
  f.component_list("step", step_, "step policies, in their order: what is made of a direction");
  f.check("step", [this] {
    const bool complete = std::any_of(step_.begin(), step_.end(), [](const auto& policy) { return policy->makes_every_step(); });
    return complete ? "" : "no policy of `step` makes every step; add `straight` after the others";
  });
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
  unbalanced_ = false;
  judge_.begin();
  stagnation_.begin();
  begin(problem, result);
  for (const auto& policy : step_) policy->begin(problem);
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
    check_size(p, q);
    if (!p.allFinite())
      throw FaultyDirection(type(), "not finite", end(MinimizerStatus::line_search_failed));
    ++result.iterations;
    if (newton_like()) result.residual = newton_norm(problem, p, result);
    const bool last = newton_like() && result.residual <= 1;
    // Directions that would end the minimisation stay as they are. If forces were out of balance
    // after such a direction, the next ones are accelerated like all others, but within the
    // tolerance, so that a body near its equilibrium is not carried past it.
    StepContext context{problem, *line_search_, result, newton_like(), newton_like() && (!last || unbalanced_), last, std::numeric_limits<double>::infinity()};
    for (const auto& policy : step_) policy->direct(context, q, p);
    if (last) context.length_max = 1 / problem.stopping_norm(p, objective.gradient());
    const VecX before = last ? q : VecX();
    const bool downhill = descends(objective.gradient(), p);
    const MinimizerStatus moved = advance(context, p, q);
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
    if (moved == MinimizerStatus::line_search_failed && !downhill)
      throw FaultyDirection(type(), "no descent direction", end(moved));
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

// Moves q by the step that the policies make of p.
MinimizerStatus DescentMinimizer::advance(const StepContext& context, const VecX& p, VecX& q) {
  std::optional<MadeStep> made;
  std::optional<MinimizerStatus> status;
  for (const auto& policy : step_) {
    status = policy->advance(context, p, q, made);
    if (status) break;
  }
  if (*status != MinimizerStatus::converged) return *status;
  if (made) stepped(context.problem, *made);
  else restart(context.problem);
  for (const auto& policy : step_) policy->after(context, made ? &*made : nullptr, q);
  return MinimizerStatus::converged;
}

}  // namespace tack
