// Gradient descent in the metric of the diagonal blocks of the first Hessian, with the step lengths
// of Barzilai and Borwein. A baseline for other methods; slow by nature.
#include <algorithm>

#include "framework/config/field.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/start_preconditioner.hpp"

namespace tack {

class GradientDescent : public DescentMinimizer {
 public:
  GradientDescent() { max_iterations_ = 20000; }
  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    metric_.fields(f);
  }

 protected:
  void begin(const MinimizerProblem& problem, MinimizerResult& result) override {
    usable_ = metric_.begin(problem, result);
    length_ = 1;
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult&) override {
    if (!usable_) return MinimizerStatus::factorization_failed;
    gradient_ = problem.objective.gradient();
    metric_.apply(gradient_, p, problem.clock);
    p *= -length_;
    return MinimizerStatus::converged;
  }

  void stepped(const MinimizerProblem& problem, const Step& step) override {
    // In the metric B with s = -length B^-1 g: s.B s / s.y.
    const double sy = step.length * step.p.dot(problem.objective.gradient() - gradient_);
    const double s_metric_s = -step.length * step.length * length_ * step.slope;
    length_ = sy > 0 ? std::clamp(s_metric_s / sy, 1e-3 * length_, 1e3 * length_) : 2 * length_;
  }

 private:
  StartPreconditioner metric_{StartPreconditioner::Kind::block_diagonal};
  VecX gradient_;
  double length_ = 1;
  bool usable_ = false;
};

TACK_REGISTER(Minimizer, GradientDescent, "gradient_descent",
              "Preconditioned gradient descent: a baseline for comparisons. Thousands of iterations in stiff scenes.",
              "Barzilai and Borwein 1988");

}  // namespace tack
