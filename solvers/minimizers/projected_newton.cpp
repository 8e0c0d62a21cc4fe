// Projected Newton (the paper, section 5): each stencil's Hessian is made positive semi-definite, the
// system is solved directly, the step is cut to the feasible part and then line-searched.
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/newton_system.hpp"

namespace tack {

class ProjectedNewton : public DescentMinimizer {
 public:
  enum class Filter { clamp, absolute, on_demand };

  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    f.choice("filter", filter_,
             {{"clamp", Filter::clamp, "negative eigenvalues become zero"},
              {"absolute", Filter::absolute, "negative eigenvalues change sign"},
              {"on_demand", Filter::on_demand, "clamp where the system turns out not to be positive definite"}},
             "how a stencil's Hessian is made positive semi-definite");
    f.component("linear", linear_, "solver of the Newton system");
  }
  std::string linear_solver() const override { return linear_->describe(); }

 protected:
  bool newton_like() const override { return true; }

  void begin(const MinimizerProblem&, MinimizerResult&) override {
    indefinite_ = 0;
    careful_ = false;
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) override {
    if (filter_ == Filter::on_demand && indefinite_ < patience) {
      if (solve_unfiltered(problem, p, result)) return MinimizerStatus::converged;
      ++indefinite_;
    }
    const BlockMatrix& hessian = problem.objective.hessian(careful_ ? SpdFilter::majorize : spd_filter());
    const bool solved = solve_newton_system(*linear_, hessian, problem.objective.gradient(), p, problem.clock, result);
    return solved ? MinimizerStatus::converged : MinimizerStatus::factorization_failed;
  }

  void stepped(const MinimizerProblem&, const Step& step) override { careful_ = step.evaluations > 1; }

 private:
  SpdFilter spd_filter() const {
    return filter_ == Filter::absolute ? SpdFilter::absolute : SpdFilter::clamp;
  }

  // p <- -H^-1 g without a filter. False if H shows a negative curvature, or p does not descend.
  bool solve_unfiltered(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) {
    const BlockMatrix& hessian = problem.objective.hessian(SpdFilter::none);
    const VecX& gradient = problem.objective.gradient();
    ++result.linear_solves;
    if (!linear_->factorize(hessian, problem.clock)) return false;
    linear_->solve(-gradient, p, problem.clock);
    return p.allFinite() && p.dot(gradient) < 0;
  }

  // Indefinite systems in one solve after which all are filtered at once.
  static constexpr int patience = 2;

  Filter filter_ = Filter::clamp;
  std::unique_ptr<LinearSolver> linear_ = Registry<LinearSolver>::make("auto");
  int indefinite_ = 0;
  bool careful_ = false;  // the last step went too far
};

TACK_REGISTER(Minimizer, ProjectedNewton, "projected_newton",
              "Newton's method with per-stencil positive definite Hessians and a direct solver.",
              "Li et al. 2020, Incremental Potential Contact; Fang et al., section 5");

}  // namespace tack
