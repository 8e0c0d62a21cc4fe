// Preconditioned nonlinear conjugate gradients (Nocedal and Wright, 5.2). A conjugate direction has
// no natural length: the first trial length comes from the last step.
#include <algorithm>

#include "framework/config/field.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/start_preconditioner.hpp"

namespace tack {

class NonlinearCg : public DescentMinimizer {
 public:
  enum class Beta { polak_ribiere, hestenes_stiefel, hybrid };

  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    f.choice("beta", beta_,
             {{"polak_ribiere", Beta::polak_ribiere, "Polak and Ribiere, not negative"},
              {"hestenes_stiefel", Beta::hestenes_stiefel, "Hestenes and Stiefel, not negative"},
              {"hybrid", Beta::hybrid, "the smaller of Hestenes and Stiefel's and Dai and Yuan's"}},
             "formula of the conjugate direction");
    metric_.fields(f);
  }

 protected:
  void begin(const MinimizerProblem& problem, MinimizerResult& result) override {
    usable_ = metric_.begin(problem, result);
    last_.resize(0);
    scale_ = 1;
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult&) override {
    if (!usable_) return MinimizerStatus::factorization_failed;
    const VecX& g = problem.objective.gradient();
    metric_.apply(g, z_, problem.clock);
    const double gz = g.dot(z_);
    if (last_.size() == 0) {
      direction_ = -z_;
    } else {
      direction_ = -z_ + beta(g, gz) * direction_;
      if (!(direction_.dot(g) < 0)) direction_ = -z_;
    }
    last_ = g;
    last_gz_ = gz;
    p = scale_ * direction_;
    return MinimizerStatus::converged;
  }

  // Sets the next trial to the zero of the slope along this step, in units of the direction.
  void stepped(const MinimizerProblem& problem, const Step& step) override {
    const double slope_after = problem.objective.gradient().dot(step.p);
    const double curvature = (slope_after - step.slope) / step.length;
    const double best = curvature > 0 ? -step.slope / curvature : 2.0;
    scale_ *= std::clamp(best, 0.1, 10.0);
  }

  bool restart(const MinimizerProblem&) override {
    const bool something_to_forget = last_.size() > 0 && direction_ != -z_;
    last_.resize(0);
    scale_ = 1;
    return something_to_forget;
  }

 private:
  double beta(const VecX& g, double gz) const {
    if (beta_ == Beta::polak_ribiere) return std::max(0.0, (gz - last_.dot(z_)) / last_gz_);
    const double dy = direction_.dot(g) - direction_.dot(last_);
    if (!(dy > 0)) return 0;
    const double hestenes_stiefel = std::max(0.0, (gz - last_.dot(z_)) / dy);
    return beta_ == Beta::hybrid ? std::min(hestenes_stiefel, gz / dy) : hestenes_stiefel;
  }

  Beta beta_ = Beta::polak_ribiere;
  StartPreconditioner metric_;
  VecX z_, last_, direction_;  // preconditioned gradient; the last gradient; not scaled
  double last_gz_ = 0, scale_ = 1;
  bool usable_ = false;
};

TACK_REGISTER(Minimizer, NonlinearCg, "nonlinear_cg",
              "Nonlinear conjugate gradients, preconditioned by a Hessian that is factorised once per solve.",
              "Polak and Ribiere 1969; Nocedal and Wright, Numerical Optimization, 5.2");

}  // namespace tack
