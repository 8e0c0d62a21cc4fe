// Retracted steps: the end of a fraction of the direction, with stiff bodies rotated instead of
// strained (framework/stepping/step_retraction.hpp). Only for Newton directions, and where the
// problem has such bodies; every other step is left to the next policy.
#include <algorithm>

#include "solvers/steps/step_policy.hpp"

namespace tack {
namespace {

// Fraction of the straight step's gain that strains may take without a retraction.
constexpr double tolerated_loss = 1e-6;
constexpr double shortest = 1e-4;    // fraction of the direction, below which none is tried
constexpr double shorter = 0.9;      // factor on a feasible fraction, which is that of another path
constexpr double sufficient = 1e-4;  // Armijo's constant

class Retraction : public StepPolicy {
 public:
  std::optional<MinimizerStatus> advance(const StepContext& context, const VecX& p, VecX& q, std::optional<MadeStep>& made) override {
    const MinimizerProblem& problem = context.problem;
    if (!problem.retract || !context.newton_like) return std::nullopt;
    Objective& objective = problem.objective;
    const double slope = objective.gradient().dot(p), before = objective.value(), noise = objective.value_noise();
    int evaluations = 0;
    double feasible = 1;
    for (double t = 1; t > shortest && -t * slope > 2 * noise;) {
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
      ++context.result.line_search_evaluations;
      if (descends(before, value, std::max(noise, objective.value_noise()), t, slope, sufficient)) {
        q += step;
        made.emplace(MadeStep{p, t, feasible, evaluations, slope, before, before - value, false});
        return MinimizerStatus::converged;
      }
      t /= 2;
    }
    if (evaluations > 0) objective.move_to(q);
    return std::nullopt;
  }
};

TACK_REGISTER(StepPolicy, Retraction, "retraction", "Rotates affine bodies along the step instead of straining them.",
              "Absil, Mahony, Sepulchre 2008, Optimization Algorithms on Matrix Manifolds, 4.1");

}  // namespace
}  // namespace tack
