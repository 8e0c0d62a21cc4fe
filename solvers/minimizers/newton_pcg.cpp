// Inexact Newton: iterations solve each system as accurately as the progress of the last step
// deserves (forcing_term.hpp).
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/direction_check.hpp"
#include "solvers/minimizers/forcing_term.hpp"
#include "solvers/minimizers/shifted_factor.hpp"

namespace tack {

class NewtonPcg : public DescentMinimizer {
 public:
  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    forcing_.fields(f);
    f.component("linear", linear_, "iterative solver of the Newton systems");
  }
  std::string linear_solver() const override { return linear_->describe(); }

 protected:
  bool newton_like() const override { return shift_ == 0; }
  double newton_norm(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) override {
    return check_.norm(*linear_, *hessian_, problem, p, result);
  }

  void begin(const MinimizerProblem&, MinimizerResult&) override {
    forcing_.begin();
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
    return solve(forcing_.next(gradient.norm())) ? MinimizerStatus::converged : MinimizerStatus::factorization_failed;
  }

 private:
  ForcingTerm forcing_;
  std::unique_ptr<LinearSolver> linear_ = Registry<LinearSolver>::make("pcg");
  DirectionCheck check_;
  const BlockMatrix* hessian_ = nullptr;  // of the last system
  double shift_ = 0;                      // of its matrix
};

TACK_REGISTER(Minimizer, NewtonPcg, "newton_pcg",
              "Inexact Newton method: conjugate gradients solve the systems with an adaptive tolerance (forcing term).",
              "Eisenstat and Walker 1996, Choosing the Forcing Terms in an Inexact Newton Method");

}  // namespace tack
