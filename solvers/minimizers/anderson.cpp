// Anderson acceleration of the preconditioned fixed point q <- q + b f(q), f = -B^-1 g, B the
// Hessian at the start of the minimisation. Of the last m steps dx_i and changes df_i of the
// residual,
//     p = b f - sum_i c_i (dx_i + b df_i),   c = argmin |f - sum_i c_i df_i|_B,
// the point that the residual's linear model over these steps sends to zero as far as it can. In
// the metric B no product with B is needed, since B df_i is minus the change of the gradient.
// The mixing b is what the line search makes of plain steps, p = b f: contact that is not in B makes
// it small. Safeguards: a p that descends by too little is replaced by b f, and the steps are
// forgotten; step filters and the line search treat p as every other direction.
#include <Eigen/Cholesky>
#include <algorithm>
#include <deque>

#include "framework/config/field.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/start_preconditioner.hpp"

namespace tack {

class Anderson : public DescentMinimizer {
 public:
  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    f.integer("window", window_, "steps that are combined; 0: the plain fixed point").range(0, 100);
    f.number("descent_min", descent_min_, units::none,
             "slope of the accelerated direction over that of the plain one, below which the plain one is taken").range(0, 1);
    metric_.fields(f);
  }

 protected:
  void begin(const MinimizerProblem& problem, MinimizerResult& result) override {
    usable_ = metric_.begin(problem, result);
    gradient_.resize(0);
    steps_.clear();
    mixing_ = 1;
    plain_ = false;
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult&) override {
    if (!usable_) return MinimizerStatus::factorization_failed;
    evaluate(problem);
    p = -mixing_ * z_;
    plain_ = true;
    if (steps_.empty()) return MinimizerStatus::converged;
    const VecX accelerated = p - combination();
    const double slope = p.dot(gradient_);
    plain_ = !(accelerated.allFinite() && accelerated.dot(gradient_) < descent_min_ * slope);
    if (plain_) steps_.clear();
    else p = accelerated;
    return MinimizerStatus::converged;
  }

  void stepped(const MinimizerProblem& problem, const Step& step) override {
    if (plain_) mixing_ = step.evaluations > 1 ? mixing_ * step.length / step.feasible : std::min(1.0, 2 * mixing_);
    if (window_ == 0) return;
    Change change{step.length * step.p, -gradient_, -z_};
    evaluate(problem);
    change.y += gradient_;
    change.z += z_;
    if (!(change.y.dot(change.z) > 0)) return;
    if (static_cast<int>(steps_.size()) == window_) steps_.pop_front();
    steps_.push_back(std::move(change));
  }

  bool restart(const MinimizerProblem&) override {
    const bool something_to_forget = !steps_.empty();
    steps_.clear();
    mixing_ = 1;
    return something_to_forget;
  }

 private:
  struct Change {
    VecX x, y, z;  // of the unknowns, of g, and of B^-1 g
  };

  // Evaluates g and B^-1 g at the objective's present point, unless they are known.
  void evaluate(const MinimizerProblem& problem) {
    const VecX& gradient = problem.objective.gradient();
    if (gradient_.size() == gradient.size() && gradient_ == gradient) return;
    gradient_ = gradient;
    metric_.apply(gradient_, z_, problem.clock);
  }

  // Returns sum_i c_i (dx_i + b df_i), df_i = -dz_i.
  VecX combination() const {
    // Relative addition to the diagonal: steps may be nearly dependent.
    constexpr double regularization = 1e-12;
    const auto n = static_cast<Eigen::Index>(steps_.size());
    Eigen::MatrixXd products(n, n);
    VecX right(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) products(i, j) = products(j, i) = steps_[i].z.dot(steps_[j].y);
      right(i) = steps_[i].y.dot(z_);
    }
    products.diagonal() *= 1 + regularization;
    const VecX c = products.ldlt().solve(right);
    VecX sum = VecX::Zero(z_.size());
    for (Eigen::Index i = 0; i < n; ++i) sum += c(i) * (steps_[i].x - mixing_ * steps_[i].z);
    return sum;
  }

  int window_ = 20;
  double descent_min_ = 0.01;
  StartPreconditioner metric_;
  std::deque<Change> steps_;
  VecX gradient_, z_;  // g and B^-1 g where they were evaluated last
  double mixing_ = 1;
  bool plain_ = false;  // the last direction was not accelerated
  bool usable_ = false;
};

TACK_REGISTER(Minimizer, Anderson, "anderson",
              "Anderson acceleration of a fixed point that is preconditioned by a Hessian factorised once per solve.",
              "Anderson 1965; Walker and Ni 2011, Anderson Acceleration for Fixed-Point Iterations");

}  // namespace tack
