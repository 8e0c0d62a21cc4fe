// L-BFGS (Nocedal and Wright, algorithm 7.4) that starts from a Hessian factorised once per solve.
// Pairs without positive curvature are skipped: steps truncated by contact need not satisfy the
// curvature condition.
#include <deque>

#include "framework/config/field.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/start_preconditioner.hpp"

namespace tack {

class Lbfgs : public DescentMinimizer {
 public:
  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    f.integer("history", history_, "curvature pairs that are stored").range(1, 1000);
    metric_.fields(f);
  }

 protected:
  void begin(const MinimizerProblem& problem, MinimizerResult& result) override {
    pairs_.clear();
    usable_ = metric_.begin(problem, result);
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult&) override {
    if (!usable_) return MinimizerStatus::factorization_failed;
    gradient_ = problem.objective.gradient();
    VecX r = -gradient_;
    for (auto pair = pairs_.rbegin(); pair != pairs_.rend(); ++pair) {
      pair->alpha = pair->s.dot(r) / pair->sy;
      r -= pair->alpha * pair->y;
    }
    metric_.apply(r, p, problem.clock);
    for (const Pair& pair : pairs_) p += (pair.alpha - pair.y.dot(p) / pair.sy) * pair.s;
    return MinimizerStatus::converged;
  }

  void stepped(const MinimizerProblem& problem, const Step& step) override {
    Pair pair{step.length * step.p, problem.objective.gradient() - gradient_, 0, 0};
    pair.sy = pair.s.dot(pair.y);
    if (!(pair.sy > 1e-10 * pair.s.norm() * pair.y.norm())) return;
    if (static_cast<int>(pairs_.size()) == history_) pairs_.pop_front();
    pairs_.push_back(std::move(pair));
  }

  // The stored pairs may be out of date; the metric alone may still give a decrease.
  bool restart(const MinimizerProblem&) override {
    const bool something_to_forget = !pairs_.empty();
    pairs_.clear();
    return something_to_forget;
  }

 private:
  struct Pair {
    VecX s, y;  // steps and changes of the gradient
    double sy, alpha;
  };

  int history_ = 10;
  StartPreconditioner metric_;
  std::deque<Pair> pairs_;
  VecX gradient_;  // where the last direction was made
  bool usable_ = false;
};

TACK_REGISTER(Minimizer, Lbfgs, "lbfgs",
              "Limited-memory BFGS, started from a Hessian that is factorised once per solve.",
              "Liu and Nocedal 1989; Liu, Bouaziz, Kavan 2017 (initial Hessian)");

}  // namespace tack
