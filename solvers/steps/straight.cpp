// The straight step: along the direction, truncated to its feasible length and line-searched.
#include "solvers/steps/step_policy.hpp"

namespace tack {
namespace {

constexpr double shortest_feasible = 1e-12;  // a step whose feasible length is below is blocked

class StraightStep : public StepPolicy {
 public:
  bool makes_every_step() const override { return true; }

  std::optional<MinimizerStatus> advance(const StepContext& context, const VecX& p, VecX& q, std::optional<MadeStep>& made) override {
    const MinimizerProblem& problem = context.problem;
    Objective& objective = problem.objective;
    const double t_max = problem.feasible_step(q, p);
    if (!(t_max > shortest_feasible)) return MinimizerStatus::blocked;
    const PhaseScope scope(problem.clock, Phase::line_search);
    const double slope = objective.gradient().dot(p);
    if (!(slope < 0)) return MinimizerStatus::line_search_failed;
    const double before = objective.value();
    const LineSearchResult found = context.line_search.search(objective, q, p, slope, t_max);
    context.result.line_search_evaluations += found.evaluations;
    if (!found.found) {
      objective.move_to(q);
      return MinimizerStatus::line_search_failed;
    }
    q += found.step * p;
    made.emplace(MadeStep{p, found.step, t_max, found.evaluations, slope, before, before - objective.value(), true});
    return MinimizerStatus::converged;
  }
};

TACK_REGISTER(StepPolicy, StraightStep, "straight", "Along the direction, up to its feasible length, with a line search.",
              "Li et al. 2020, Incremental Potential Contact");

}  // namespace
}  // namespace tack
