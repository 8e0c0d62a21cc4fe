// Projected Newton (the paper, section 5): each stencil's Hessian is made positive semi-definite, the
// system is solved directly, the step is cut to the feasible part and then line-searched.
#include <cmath>
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/interrupt.hpp"
#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"
#include "solvers/line_search/line_search.hpp"

namespace tack {

class ProjectedNewton : public Minimizer {
 public:
  enum class Filter { clamp, absolute, on_demand };

  void fields(Fields& f) override {
    Minimizer::fields(f);
    f.choice("filter", filter_,
             {{"clamp", Filter::clamp, "negative eigenvalues become zero"},
              {"absolute", Filter::absolute, "negative eigenvalues change sign"},
              {"on_demand", Filter::on_demand, "clamp where the system turns out not to be positive definite"}},
             "how a stencil's Hessian is made positive semi-definite");
    f.component("linear", linear_, "solver of the Newton system");
    f.component("line_search", line_search_, "step length");
  }

  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) override {
    MinimizerResult result;
    Objective& objective = problem.objective;
    objective.move_to(q);
    VecX p;
    int indefinite = 0;
    bool careful = false;  // the last step went too far
    while (result.iterations < max_iterations_) {
      if (interrupt_requested) return fail(result, MinimizerStatus::interrupted);
      const bool try_unfiltered = filter_ == Filter::on_demand && indefinite < patience;
      if (!(try_unfiltered && solve_unfiltered(problem, p, result))) {
        indefinite += try_unfiltered;
        const BlockMatrix& hessian = objective.hessian(careful ? SpdFilter::majorize : spd_filter());
        const VecX& gradient = objective.gradient();
        if (!gradient.allFinite()) return fail(result, MinimizerStatus::not_finite);
        if (!solve(hessian, gradient, p, problem.clock, result))
          return fail(result, MinimizerStatus::factorization_failed);
      }
      ++result.iterations;
      result.residual = problem.stopping_norm(p, objective.gradient());
      const bool last = result.residual <= 1;
      const int evaluations = result.line_search_evaluations;
      const MinimizerStatus status = advance(problem, p, q, result);
      careful = result.line_search_evaluations > evaluations + 1;
      // Below the tolerance the point is accepted as it is, whether or not the last step helped.
      if (last) return result;
      if (status != MinimizerStatus::converged) return fail(result, status);
    }
    return fail(result, MinimizerStatus::iteration_limit);
  }

 private:
  SpdFilter spd_filter() const {
    return filter_ == Filter::absolute ? SpdFilter::absolute : SpdFilter::clamp;
  }

  static MinimizerResult fail(MinimizerResult result, MinimizerStatus status) {
    result.status = status;
    return result;
  }

  // p <- -H^-1 g without a filter. False if H shows a negative curvature, or p does not descend.
  bool solve_unfiltered(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) {
    const BlockMatrix& hessian = problem.objective.hessian(SpdFilter::none);
    const VecX& gradient = problem.objective.gradient();
    ++result.linear_solves;
    if (!gradient.allFinite() || !linear_->factorize(hessian, problem.clock)) return false;
    linear_->solve(-gradient, p, problem.clock);
    return p.allFinite() && p.dot(gradient) < 0;
  }

  // p <- -H^-1 g; a semi-definite H (free rigid motions of a quasi-static body) gets a growing shift.
  bool solve(const BlockMatrix& hessian, const VecX& gradient, VecX& p, PhaseClock& clock,
             MinimizerResult& result) {
    ++result.linear_solves;
    if (linear_->factorize(hessian, clock)) {
      linear_->solve(-gradient, p, clock);
      if (p.allFinite()) return true;
    }
    BlockMatrix shifted = hessian;
    double largest = 0;
    for (int c = 0; c < shifted.columns(); ++c)
      largest = std::max(largest, shifted.block(shifted.column_start[c]).diagonal().maxCoeff());
    for (double shift = 1e-10; shift <= 1; shift *= 100) {
      for (int c = 0; c < shifted.columns(); ++c)
        shifted.block(shifted.column_start[c]).diagonal() =
            hessian.block(shifted.column_start[c]).diagonal().array() + shift * largest;
      ++result.linear_solves;
      if (!linear_->factorize(shifted, clock)) continue;
      linear_->solve(-gradient, p, clock);
      if (p.allFinite()) return true;
    }
    return false;
  }

  // Moves q along the feasible part of p.
  MinimizerStatus advance(const MinimizerProblem& problem, const VecX& p, VecX& q,
                          MinimizerResult& result) {
    Objective& objective = problem.objective;
    const double t_max = problem.feasible_step(q, p);
    if (!(t_max > 1e-12)) return MinimizerStatus::blocked;
    const PhaseScope scope(problem.clock, Phase::line_search);
    const double slope = objective.gradient().dot(p);
    if (slope >= 0) return MinimizerStatus::line_search_failed;
    const LineSearchResult found = line_search_->search(objective, q, p, slope, t_max);
    result.line_search_evaluations += found.evaluations;
    if (!found.found) {
      objective.move_to(q);
      return MinimizerStatus::line_search_failed;
    }
    q += found.step * p;
    return MinimizerStatus::converged;
  }

  // Indefinite systems in one solve after which all are filtered at once.
  static constexpr int patience = 2;

  Filter filter_ = Filter::clamp;
  std::unique_ptr<LinearSolver> linear_ = Registry<LinearSolver>::make("lagged_cholesky");
  std::unique_ptr<LineSearch> line_search_ = Registry<LineSearch>::make("backtracking");
};

TACK_REGISTER(Minimizer, ProjectedNewton, "projected_newton",
              "Newton's method with per-stencil positive definite Hessians and a direct solver.",
              "Li et al. 2020, Incremental Potential Contact; Fang et al., section 5");

}  // namespace tack
