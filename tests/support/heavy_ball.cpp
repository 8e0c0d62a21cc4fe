// The heavy ball method: descent that adds a fraction of its last step.
#include "framework/config/field.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/start_preconditioner.hpp"

namespace tack {

class HeavyBall : public DescentMinimizer {
 public:
  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    f.number("momentum", momentum_, units::none, "part of the last step in the next").range(0, 0.99);
    metric_.fields(f);
  }

 protected:
  void begin(const MinimizerProblem& problem, MinimizerResult& result) override {
    usable_ = metric_.begin(problem, result);
    last_.resize(0);
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult&) override {
    if (!usable_) return MinimizerStatus::factorization_failed;
    const VecX& gradient = problem.objective.gradient();
    metric_.apply(-gradient, p, problem.clock);
    if (last_.size() > 0 && gradient.dot(p + momentum_ * last_) < 0) p += momentum_ * last_;
    return MinimizerStatus::converged;
  }

  void stepped(const MinimizerProblem&, const Step& step) override { last_ = step.length * step.p; }

  bool restart(const MinimizerProblem&) override {
    const bool something_to_forget = last_.size() > 0;
    last_.resize(0);
    return something_to_forget;
  }

 private:
  StartPreconditioner metric_;
  double momentum_ = 0.3;
  VecX last_;
  bool usable_ = false;
};

TACK_REGISTER(Minimizer, HeavyBall, "heavy_ball", "Descent with momentum.", "Polyak 1964");
}  // namespace tack
