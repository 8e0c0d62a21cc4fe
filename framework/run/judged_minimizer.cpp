#include "framework/run/judged_minimizer.hpp"

#include <chrono>

#include "framework/config/bind.hpp"
#include "framework/run/cpu_limit.hpp"
#include "framework/run/reference_solver.hpp"

namespace tack {
namespace {

class JudgedMinimizer : public Minimizer {
 public:
  JudgedMinimizer(std::unique_ptr<Minimizer> inner, Judgement& judgement) : inner_(std::move(inner)), judgement_(judgement) {
    static_cast<Minimizer&>(*this) = *inner_;
  }

  std::unique_ptr<Minimizer> fresh() const override { return inner_->fresh(); }
  std::string linear_solver() const override { return inner_->linear_solver(); }
  void admit(const std::vector<const Term*>& terms, int unknowns) const override { inner_->admit(terms, unknowns); }

  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) override {
    const MinimizerResult result = inner_->minimize(problem, q);
    const double begun = cpu_now();
    const auto wall = std::chrono::steady_clock::now();
    judge(problem, q);
    judgement_.cpu_seconds += cpu_now() - begun;
    judgement_.wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    return result;
  }

 private:
  // Makes the first iteration of Newton's method at q, for the norm of its direction.
  void judge(const MinimizerProblem& problem, const VecX& q) {
    Value keys = reference_solver("clamp", "cholmod", 1);
    keys.set("max_iterations", Value::number(1));
    const std::unique_ptr<Minimizer> newton = bind_component<Minimizer>(keys);
    judgement_.residual.reset();
    MinimizerProblem observed = problem;
    bool first = true;
    observed.observer = [&](int, double residual, double, double) {
      if (first) judgement_.residual = residual;
      first = false;
    };
    VecX end = q;
    newton->minimize(observed, end);
    problem.objective.move_to(q);
  }

  std::unique_ptr<Minimizer> inner_;
  Judgement& judgement_;
};

}  // namespace

std::unique_ptr<Minimizer> judged(std::unique_ptr<Minimizer> inner, Judgement& judgement) {
  return std::make_unique<JudgedMinimizer>(std::move(inner), judgement);
}

}  // namespace tack
