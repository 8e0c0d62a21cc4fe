// Nonlinear elimination of what cuts a step. A step that is truncated leaves most vertices short of
// where they were going because of a few pairs and elements. After such a step the blocks of these,
// with rings of neighbours, are minimised over alone, the others at rest (MinimizerProblem::local),
// before the method finds its next direction. Taken are all pairs and elements that would have cut
// the step by themselves, not the tightest alone: the next one would cut the next step.
// Iterations of local problems are counted as linear solves, not as iterations.
#include <algorithm>

#include "framework/config/field.hpp"
#include "solvers/steps/step_policy.hpp"

namespace tack {
namespace {

class Elimination : public StepPolicy {
 public:
  void fields(Fields& f) override {
    f.number("below", below_, units::none, "feasible fraction of a step below which what cuts it is eliminated").range(0, 1);
    f.integer("rings", rings_, "rings of neighbours around what cuts a step").range(0, 10);
    f.number("share_max", share_max_, units::none, "largest fraction of all blocks that is eliminated; above it nothing is").range(0, 1);
    f.number("accuracy", accuracy_, units::none, "largest Newton step at which a local problem ends, over that of the step that was cut").range(1e-9, 1);
    f.component("minimizer", minimizer_, "minimiser of the local problems");
  }

  void after(const StepContext& context, const MadeStep* made, VecX& q) override {
    const MinimizerProblem& problem = context.problem;
    if (!made || !made->straight || made->feasible >= below_ || context.within || !problem.local || !problem.cuts) return;
    const std::vector<int> blocks = region(problem, q - made->length * made->p, made->p);
    problem.objective.move_to(q);  // the search of cuts may have moved what others share
    if (blocks.empty() || static_cast<double>(blocks.size()) > share_max_ * static_cast<double>(q.size() / 3)) return;
    const double end = accuracy_ * made->p.lpNorm<Eigen::Infinity>();
    {
      const LocalProblem local = problem.local(blocks);
      const MinimizerProblem own{*local.objective, local.feasible_step, [end](const VecX& step, const VecX&) { return step.lpNorm<Eigen::Infinity>() / end; }, problem.clock};
      VecX at = local.q;
      const MinimizerResult result = minimizer_->minimize(own, at);
      context.result.linear_solves += result.linear_solves;
      context.result.linear_iterations += result.linear_iterations;
      context.result.line_search_evaluations += result.line_search_evaluations;
      for (size_t i = 0; i < blocks.size(); ++i) q.segment<3>(3 * static_cast<Eigen::Index>(blocks[i])) = at.segment<3>(3 * static_cast<Eigen::Index>(i));
    }
    problem.objective.move_to(q);
  }

 private:
  // Returns the blocks of all that cuts the step from q to q + p, with rings of neighbours.
  std::vector<int> region(const MinimizerProblem& problem, const VecX& q, const VecX& p) const {
    std::vector<int> blocks = problem.cuts(q, p, 1).blocks;
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    for (int ring = 0; ring < rings_ && problem.with_neighbours; ++ring) blocks = problem.with_neighbours(blocks);
    return blocks;
  }

  // Study: hardest steps of an octocat that falls on squares (docs/log/minimisation.md).
  double below_ = 0.9, share_max_ = 0.5, accuracy_ = 0.02;
  int rings_ = 2;
  std::unique_ptr<Minimizer> minimizer_ = Registry<Minimizer>::make("projected_newton");
};

TACK_REGISTER(StepPolicy, Elimination, "elimination", "After a truncated step, minimises over what cut it and its neighbours alone.",
              "Cai and Keyes 2002, Nonlinearly Preconditioned Inexact Newton Algorithms");

}  // namespace
}  // namespace tack
