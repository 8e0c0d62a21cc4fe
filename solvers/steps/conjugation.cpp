// Conjugate directions. With the last step s and the change y of the gradient along it,
//     p <- p + beta s,    p . y = 0,    beta >= 0,
// which adds the exact Hessian's curvature along s, where a projection may have removed it: a
// Newton step that decreases the objective by far more than its model predicts was too short. beta
// vanishes where the model is exact.
#include <cmath>

#include "solvers/steps/step_policy.hpp"

namespace tack {
namespace {

// A Hessian is too stiff if a step of at least `longish` decreases the objective by `too_much`
// times the predicted decrease.
constexpr double longish = 0.3, too_much = 1.25;
constexpr double almost_whole = 0.9;  // step lengths below it were truncated
constexpr double correction_max = 4;         // length of beta s, over the lengths of p and s
// Fraction of the Newton slope that a conjugate direction must keep.
constexpr double descent = 0.1;

class Conjugation : public StepPolicy {
 public:
  void begin(const MinimizerProblem&) override {
    gradient_before_.resize(0);
    too_stiff_ = truncated_ = false;
  }

  void direct(const StepContext& context, const VecX& q, VecX& p) override {
    if (context.accelerate) conjugate(context, q, p);
    truncated_ = false;
  }

  void after(const StepContext& context, const MadeStep* made, VecX&) override {
    if (!made) return begin(context.problem);
    if (!made->straight) return;
    const double predicted = -(made->length - made->length * made->length / 2) * made->slope;
    too_stiff_ |= made->length > longish && made->decrease > too_much * predicted && made->decrease > 2 * context.problem.objective.value_noise();
    truncated_ = made->length < almost_whole;
  }

 private:
  void conjugate(const StepContext& context, const VecX& q, VecX& p) {
    const MinimizerProblem& problem = context.problem;
    const VecX& gradient = problem.objective.gradient();
    // a truncated step says little of the metric, and longer directions would be truncated again
    if (truncated_) {
      gradient_before_.resize(0);
      too_stiff_ = false;
    }
    if (too_stiff_ && gradient_before_.size() == gradient.size()) {
      const VecX s = q - q_before_, change = gradient - gradient_before_;
      const double curvature = s.dot(change), beta = curvature > 0 ? -p.dot(change) / curvature : 0;
      const bool short_enough = std::abs(beta) * s.norm() < correction_max * (p.norm() + s.norm());
      const VecX to = p + beta * s;
      if (beta > 0 && short_enough && to.dot(gradient) < descent * p.dot(gradient) &&
          (!context.within || problem.stopping_norm(to, gradient) <= 1))
        p = to;
    }
    gradient_before_ = gradient;
    q_before_ = q;
  }

  VecX gradient_before_, q_before_;  // at the last accelerated iteration of this minimisation
  // Hessians of this minimisation are too stiff, since some step, and no step was truncated
  bool too_stiff_ = false;
  bool truncated_ = false;  // the last step was truncated
};

TACK_REGISTER(StepPolicy, Conjugation, "conjugation", "Makes Newton directions conjugate to the last step where projected Hessians are too stiff.",
              "Hestenes and Stiefel 1952; Nocedal and Wright, Numerical Optimization, 5.2");

}  // namespace
}  // namespace tack
