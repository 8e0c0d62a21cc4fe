// Conjugate gradients preconditioned by the Cholesky factor of an earlier matrix. The matrix
// changes little between Newton iterations and time steps except for a few contacts, so that a few
// iterations replace a factorisation. Once they no longer do, the matrix is factorised again. The
// decision counts iterations, not seconds, so that runs repeat bit for bit.
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "solvers/linear/conjugate_gradients.hpp"

namespace tack {

class LaggedCholesky : public LinearSolver {
 public:
  void fields(Fields& f) override {
    f.component("direct", direct_, "solver that factorises");
    f.number("tolerance", tolerance_, units::none,
             "residual of the system, relative, in the norm of the preconditioner").range(1e-14, 0.5);
    f.integer("max_iterations", max_iterations_,
              "estimated cost of a factorisation, in conjugate gradient iterations").at_least(1);
  }

  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) override {
    matrix_ = &matrix;
    fresh_ = false;
    const bool usable = size_ == matrix.size() && !stale_;
    return usable || refresh(clock);
  }

  void solve(const VecX& b, VecX& x, PhaseClock& clock) override {
    if (iterate(b, x, tolerance_, clock)) stale_ = cg_.iterations() > max_iterations_ / 2;
  }
  // Improves x to the relative residual. Its iterations do not count for the decision on the next
  // matrix.
  void correct(const VecX& b, VecX& x, double relative, PhaseClock& clock) override {
    iterate(b, x, relative, clock);
  }

  void set_tolerance(double relative) override { tolerance_ = relative; }
  int iterations() const override { return iterations_; }
  int analyses() const override { return direct_->analyses(); }
  std::optional<FactorCost> predict(const BlockMatrix& matrix, PhaseClock& clock) override {
    return direct_->predict(matrix, clock);
  }
  std::optional<FactorCost> bound(const BlockMatrix& matrix, PhaseClock& clock) override {
    return direct_->bound(matrix, clock);
  }

 private:
  // Returns true if conjugate gradients solved the system.
  bool iterate(const VecX& b, VecX& x, double tolerance, PhaseClock& clock) {
    using Outcome = ConjugateGradients::Outcome;
    iterations_ = 0;
    for (;;) {
      if (fresh_ && direct_->exact()) {
        direct_->solve(b, x, clock);
        return false;
      }
      const Outcome outcome = cg_.solve(
          *matrix_, b, x, {tolerance, max_iterations_}, clock,
          [&](const VecX& r, VecX& z) { direct_->solve(r, z, clock); });
      iterations_ += cg_.iterations();
      if (outcome == Outcome::solved) return true;
      const bool hopeless = outcome == Outcome::indefinite || (fresh_ && !direct_->sharpen());
      if (hopeless || !refresh(clock)) {
        x.setConstant(b.size(), std::numeric_limits<double>::quiet_NaN());
        return false;
      }
    }
  }

  bool refresh(PhaseClock& clock) {
    direct_->allow_approximation();
    size_ = 0;  // no factor until the new one is complete: the deadline may pass
    fresh_ = direct_->factorize(*matrix_, clock);
    if (fresh_) size_ = matrix_->size();
    stale_ = false;
    return fresh_;
  }

  std::unique_ptr<LinearSolver> direct_ = Registry<LinearSolver>::make("multifrontal");
  double tolerance_ = 0.03;
  int max_iterations_ = 12;

  const BlockMatrix* matrix_ = nullptr;
  int iterations_ = 0;  // of the last solve, with all factors that it used
  int size_ = 0;        // of the factor; 0: none
  bool fresh_ = false;  // the factor is that of matrix_
  // The last solve took so many iterations that the next one gets a new factor.
  bool stale_ = false;
  ConjugateGradients cg_;
};

TACK_REGISTER(LinearSolver, LaggedCholesky, "lagged_cholesky",
              "Conjugate gradients preconditioned by an earlier Cholesky factor.",
              "Nocedal and Wright, Numerical Optimization, 5.1 (preconditioned conjugate gradients)");

}  // namespace tack
