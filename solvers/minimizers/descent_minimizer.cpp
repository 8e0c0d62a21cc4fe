#include "solvers/minimizers/descent_minimizer.hpp"

#include <cmath>

#include "framework/config/field.hpp"
#include "framework/core/deadline.hpp"
#include "framework/core/interrupt.hpp"
#include "solvers/minimizers/tell_iteration.hpp"

namespace tack {

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
  judge_.begin();
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
    const MinimizerStatus moved = advance(problem, p, q, result);
    tell(result);
    // Below the tolerance the point is accepted as it is, whether or not the last step helped, if forces balance.
    if (last && balanced(problem, result)) return end(MinimizerStatus::converged);
    if (moved == MinimizerStatus::line_search_failed && restart(problem)) continue;
    if (moved != MinimizerStatus::converged) return end(moved);
  }
  return end(MinimizerStatus::iteration_limit);
}

// Moves q along the feasible part of p.
MinimizerStatus DescentMinimizer::advance(const MinimizerProblem& problem, const VecX& p, VecX& q,
                                          MinimizerResult& result) {
  Objective& objective = problem.objective;
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
  stepped(problem, {p, found.step, t_max, found.evaluations, slope, before - objective.value()});
  return MinimizerStatus::converged;
}

}  // namespace tack
