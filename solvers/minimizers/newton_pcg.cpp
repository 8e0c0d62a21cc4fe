// Inexact Newton: iterations solve each system as accurately as the progress of the last step
// deserves. The residual left is eta |g|, with the second choice of Eisenstat and Walker (1996),
//   eta_k = gamma (|g_k| / |g_k-1|)^2, not below gamma eta_k-1^2 while that is above 0.1,
// so that convergence stays superlinear and the first steps, far from the minimum, cost little.
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/direction_check.hpp"
#include "solvers/minimizers/shifted_factor.hpp"

namespace tack {

class NewtonPcg : public DescentMinimizer {
 public:
  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    f.number("forcing_max", forcing_max_, units::none, "largest relative residual of a system").range(1e-6, 0.5);
    f.number("forcing_min", forcing_min_, units::none,
             "smallest relative residual of a system, except the last, which is solved as accurately as the convergence test needs").range(1e-12, 0.1);
    f.component("linear", linear_, "iterative solver of the Newton systems");
    f.check("forcing_min", [this] {
      return forcing_min_ <= forcing_max_ ? "" : "forcing_min is above forcing_max";
    });
  }
  std::string linear_solver() const override { return linear_->describe(); }

 protected:
  bool newton_like() const override { return shift_ == 0; }
  double newton_norm(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) override {
    return check_.norm(*linear_, *hessian_, problem, p, result);
  }

  void begin(const MinimizerProblem&, MinimizerResult&) override {
    last_gradient_ = 0;
    shift_ = 0;
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) override {
    const BlockMatrix& hessian = problem.objective.hessian({Projection::clamp});
    const VecX& gradient = problem.objective.gradient();
    const auto solve = [&](double residual) {
      linear_->set_tolerance(residual);
      const auto shift = shifted_solve(*linear_, hessian, gradient, p, problem.clock, result);
      shift_ = shift.value_or(0);
      return shift.has_value();
    };
    hessian_ = &hessian;
    forcing_ = next_forcing(gradient.norm());
    return solve(forcing_) ? MinimizerStatus::converged : MinimizerStatus::factorization_failed;
  }

 private:
  double next_forcing(double gradient) {
    constexpr double gamma = 0.9, safeguard = 0.1;
    double forcing = forcing_max_;
    if (last_gradient_ > 0) {
      const double ratio = gradient / last_gradient_, before = gamma * forcing_ * forcing_;
      forcing = gamma * ratio * ratio;
      if (before > safeguard) forcing = std::max(forcing, before);
    }
    last_gradient_ = gradient;
    return std::clamp(forcing, forcing_min_, forcing_max_);
  }

  double forcing_max_ = 0.1;
  double forcing_min_ = 1e-3;
  std::unique_ptr<LinearSolver> linear_ = Registry<LinearSolver>::make("pcg");
  DirectionCheck check_;
  const BlockMatrix* hessian_ = nullptr;  // of the last system
  double forcing_ = 0;        // of the last system
  double shift_ = 0;          // of its matrix
  double last_gradient_ = 0;  // |g| of the last system; 0: none
};

TACK_REGISTER(Minimizer, NewtonPcg, "newton_pcg",
              "Inexact Newton method: conjugate gradients solve the systems with an adaptive tolerance (forcing term).",
              "Eisenstat and Walker 1996, Choosing the Forcing Terms in an Inexact Newton Method");

}  // namespace tack
