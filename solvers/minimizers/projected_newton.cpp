// Projected Newton (the paper, section 5): stencil Hessians are projected to positive
// semi-definite, the system is solved, the step is truncated to its feasible length and then
// line-searched.
#include <cmath>
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/direction_check.hpp"
#include "solvers/minimizers/shifted_factor.hpp"

namespace tack {

class ProjectedNewton : public DescentMinimizer {
 public:
  enum class Policy { none, clamp, contacts, absolute, on_demand, progressive, adaptive };

  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    f.choice("projection", policy_,
             {{"none", Policy::none, "the exact Hessian, shifted where it is not positive definite"},
              {"clamp", Policy::clamp, "negative eigenvalues of stencils become zero"},
              {"contacts", Policy::contacts,
               "clamp contacts only; elements too where the system turns out not to be positive definite"},
              {"absolute", Policy::absolute, "negative eigenvalues of stencils change sign"},
              {"on_demand", Policy::on_demand,
               "clamp where the system turns out not to be positive definite (Longva et al. 2023)"},
              {"progressive", Policy::progressive,
               "clamp the stencils at large residuals, more of them until the system is positive definite "
               "(Fernandez-Fernandez et al. 2026)"},
              {"adaptive", Policy::adaptive,
               "clamp while steps agree with the quadratic model, absolute otherwise (Chen et al. 2024)"}},
             "projection of the Hessian to be positive definite");
    f.component("linear", linear_, "solver of the Newton system");
  }
  std::string linear_solver() const override { return linear_->describe(); }

 protected:
  bool newton_like() const override { return shift_ == 0; }
  bool nearly_newton() const override { return shift_ <= smallest_shift; }
  double newton_norm(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) override {
    return check_.norm(*linear_, *hessian_, problem, p, result);
  }

  void begin(const MinimizerProblem&, MinimizerResult&) override {
    indefinite_ = 0;
    careful_ = false;
    model_fits_ = true;
    clamped_from_ = 2;
    wait_ = calm;
    waited_ = 0;
    shift_ = 0;
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) override {
    shift_ = 0;
    linear_->expect_indefinite(false);
    const bool solved = policy_ == Policy::progressive ? solve_progressively(problem, p, result)
                        : policy_ == Policy::contacts  ? solve_with_exact_elements(problem, p, result)
                                                       : try_unprojected(problem, p, result);
    return solved || solve_shifted(problem, p, result) ? MinimizerStatus::converged
                                                       : MinimizerStatus::factorization_failed;
  }

  void stepped(const MinimizerProblem&, const Step& step) override {
    const double t = step.length, predicted = -(t - t * t / 2) * step.slope;
    careful_ = step.evaluations > 1 || step.decrease < little * predicted;
    model_fits_ = std::abs(step.decrease / predicted - 1) <= fit;
  }

 private:
  Projection projection() const {
    switch (policy_) {
      case Policy::none: return Projection::none;
      case Policy::absolute: return Projection::absolute;
      case Policy::adaptive: return model_fits_ ? Projection::clamp : Projection::absolute;
      default: return careful_ ? Projection::majorize : Projection::clamp;
    }
  }

  // p <- -H^-1 g. Returns false if H has a negative curvature or p does not descend.
  bool solve(const BlockMatrix& hessian, const MinimizerProblem& problem, VecX& p, MinimizerResult& result) {
    const VecX& gradient = problem.objective.gradient();
    hessian_ = &hessian;
    return newton_solve(*linear_, hessian, gradient, p, problem.clock, result) && p.dot(gradient) < 0;
  }

  // Tries the unprojected Hessian. After a few failures in one minimisation, all further systems
  // are projected at once.
  bool try_unprojected(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) {
    constexpr int patience = 2;
    if (policy_ != Policy::on_demand || indefinite_ >= patience) return false;
    if (solve(problem.objective.hessian({Projection::none}), problem, p, result)) return true;
    ++indefinite_;
    return false;
  }

  // Tries exact elements. After a failure elements are clamped in the next `wait_` systems as well,
  // twice as many each time.
  bool solve_with_exact_elements(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) {
    if (waited_++ < wait_) return false;
    linear_->expect_indefinite(true);
    if (solve(problem.objective.hessian({.dynamic_projection = projection()}), problem, p, result)) {
      wait_ = 0;
      return true;
    }
    linear_->expect_indefinite(false);
    wait_ = 2 * wait_ + 1;
    waited_ = 0;
    return false;
  }

  // Clamps stencils where the gradient of a block of unknowns is above `clamped_from_` times the
  // largest one: initially none, and fewer again after a success.
  bool solve_progressively(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) {
    constexpr double tighten = 0.1, relax = 2, all = 1e-4;
    for (; clamped_from_ > all; clamped_from_ = std::min(clamped_from_, 1.0) * tighten) {
      std::vector<char> flags;
      if (clamped_from_ <= 1) flags = large_residuals(problem.objective.gradient());
      const HessianRequest request{.clamp_at = flags.empty() ? nullptr : &flags};
      if (solve(problem.objective.hessian(request), problem, p, result)) {
        clamped_from_ = std::min(relax * clamped_from_, 2.0);
        return true;
      }
    }
    return false;
  }

  bool solve_shifted(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) {
    hessian_ = &problem.objective.hessian({projection()});
    const auto shift =
        shifted_solve(*linear_, *hessian_, problem.objective.gradient(), p, problem.clock, result);
    shift_ = shift.value_or(0);
    return shift.has_value();
  }

  std::vector<char> large_residuals(const VecX& gradient) const {
    const double bound = clamped_from_ * gradient.lpNorm<Eigen::Infinity>();
    std::vector<char> large(static_cast<size_t>(gradient.size() / 3));
    for (size_t b = 0; b < large.size(); ++b)
      large[b] = gradient.segment<3>(3 * static_cast<Eigen::Index>(b)).lpNorm<Eigen::Infinity>() >= bound;
    return large;
  }

  // Iterations with easy steps, below which no trial is worth its cost.
  static constexpr int calm = 3;
  // Relative error of the predicted decrease up to which the quadratic model fits.
  static constexpr double fit = 0.01;
  // Fraction of the predicted decrease below which the step went too far.
  static constexpr double little = 0.25;

  Policy policy_ = Policy::contacts;
  std::unique_ptr<LinearSolver> linear_ = Registry<LinearSolver>::make("auto");
  DirectionCheck check_;
  const BlockMatrix* hessian_ = nullptr;  // of the last direction
  int indefinite_ = 0;
  int wait_ = 0, waited_ = 0;  // systems whose elements are clamped without a trial
  double shift_ = 0;           // of the last direction
  bool careful_ = false;       // the last step went too far
  bool model_fits_ = true;
  double clamped_from_ = 2;    // fraction of the largest residual; above 1: no stencil
};

TACK_REGISTER(Minimizer, ProjectedNewton, "projected_newton",
              "Newton's method with stencil Hessians that are projected to be positive definite.",
              "Li et al. 2020, Incremental Potential Contact; Fang et al., section 5");

}  // namespace tack
