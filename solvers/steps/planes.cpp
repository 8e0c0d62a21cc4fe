// Steps truncated block by block. Where the step as a whole is truncated, each block of unknowns
// makes its own fraction of it: as far as planes between close primitives, and the volumes of
// elements, allow whatever the others do (BlockBound::together). Taken if it descends and decreases
// the objective more than the straight step's feasible part promises; else left to the next policy.
// Worth trying for soft bodies with gaps that are large against the step. In stiff or compressed
// bodies it seldom descends: vertices that are held back strain the elements beside them.
#include "framework/config/field.hpp"
#include "solvers/steps/step_policy.hpp"

namespace tack {
namespace {

class Planes : public StepPolicy {
 public:
  void fields(Fields& f) override {
    f.number("below", below_, units::none, "feasible fraction of a step below which blocks are truncated one by one").range(0, 1);
  }

  std::optional<MinimizerStatus> advance(const StepContext& context, const VecX& p, VecX& q, std::optional<MadeStep>& made) override {
    const MinimizerProblem& problem = context.problem;
    if (!problem.block_bounds) return std::nullopt;
    const double whole = problem.feasible_step(q, p);
    if (whole >= below_) return std::nullopt;
    Objective& objective = problem.objective;
    const VecX bounds = problem.block_bounds(q, p, BlockBound::together);
    own_ = p;
    for (Eigen::Index b = 0; b < bounds.size(); ++b) own_.segment<3>(3 * b) *= bounds(b);
    const double slope = objective.gradient().dot(own_);
    if (!(slope < whole * objective.gradient().dot(p))) return std::nullopt;
    const PhaseScope scope(problem.clock, Phase::line_search);
    const double before = objective.value();
    const LineSearchResult found = context.line_search.search(objective, q, own_, slope, 1);
    context.result.line_search_evaluations += found.evaluations;
    if (!found.found) {
      objective.move_to(q);
      return std::nullopt;
    }
    q += found.step * own_;
    made.emplace(MadeStep{own_, found.step, whole, found.evaluations, slope, before, before - objective.value(), false});
    return MinimizerStatus::converged;
  }

 private:
  double below_ = 0.5;
  VecX own_;  // the direction, each block truncated
};

TACK_REGISTER(StepPolicy, Planes, "planes", "Truncates a step block by block, by planes between close primitives.",
              "after Chen et al. 2025, Offset Geometric Contact (bounds per vertex)");

}  // namespace
}  // namespace tack
