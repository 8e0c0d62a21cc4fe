// Extrapolation of whole steps. Negative curvatures that projection removed from stencils make
// Newton steps too short: at the end of p the objective still falls. Further steps along p, sized
// by its slope and the last decrease, are cheaper than a new direction. Stops when a step does not
// decrease the objective or is blocked.
#include <algorithm>
#include <utility>

#include "solvers/steps/step_policy.hpp"

namespace tack {
namespace {

constexpr double steep = 0.25;  // fraction of the first slope above which a step is extrapolated
constexpr double growth_max = 4;   // limit of one extrapolation, in units of the length so far
constexpr int most_further = 10;
constexpr double least_further = 0.1;

class Extrapolation : public StepPolicy {
 public:
  void after(const StepContext& context, const MadeStep* made, VecX& q) override {
    if (!context.accelerate || !made || !made->straight || made->length != 1) return;
    const MinimizerProblem& problem = context.problem;
    Objective& objective = problem.objective;
    double before = made->before, value = objective.value(), slope = made->slope, length = 1, travelled = 1;
    for (int i = 0; i < most_further; ++i) {
      const double change = value - before, next = 2 * change / length - slope;  // of a quadratic
      if (!(next < steep * made->slope) || !(-change > 2 * objective.value_noise())) return;
      const double bend = (next - slope) / length;
      length = bend > 0 ? std::min(-next / bend, growth_max * travelled) : growth_max * travelled;
      if (context.length_max - travelled < least_further) return;
      length = std::min(length, context.length_max - travelled);
      const VecX step = length * made->p;
      if (problem.feasible_step(q, step) < 1) return;
      objective.move_to(q + step);
      ++context.result.line_search_evaluations;
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
};

TACK_REGISTER(StepPolicy, Extrapolation, "extrapolation", "Goes on along whole Newton steps while the objective falls by more than the model predicts.", "");

}  // namespace
}  // namespace tack
