// Conjugate gradients preconditioned by a Cholesky factor of an earlier matrix. Between Newton
// iterations and time steps the matrix changes little but for a few contacts, so a handful of
// iterations replaces a factorisation. Factorises anew as soon as that no longer holds: the decision
// counts iterations, not seconds, so that runs repeat bit for bit.
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "framework/core/symmetric_product.hpp"

namespace tack {

class LaggedCholesky : public LinearSolver {
 public:
  void fields(Fields& f) override {
    f.component("direct", direct_, "makes the factor");
    f.number("tolerance", tolerance_, units::none,
             "residual of the system, relative, in the norm of the preconditioner").range(1e-14, 0.5);
    f.integer("max_iterations", max_iterations_,
              "conjugate gradient iterations that a factorisation is thought to cost").at_least(1);
  }

  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) override {
    matrix_ = &matrix;
    const bool usable = size_ == matrix.size() && !stale_;
    return usable || refresh(clock);
  }

  void solve(const VecX& b, VecX& x, PhaseClock& clock) override {
    for (;;) {
      if (fresh_ && direct_->exact()) {
        direct_->solve(b, x, clock);
        break;
      }
      const Outcome outcome = iterate(b, x, clock);
      if (outcome == Outcome::solved) break;
      const bool hopeless = outcome == Outcome::indefinite || (fresh_ && !direct_->sharpen());
      if (hopeless || !refresh(clock)) {
        x.setConstant(b.size(), std::numeric_limits<double>::quiet_NaN());
        break;
      }
    }
    fresh_ = false;
  }

  int analyses() const override { return direct_->analyses(); }

 private:
  bool refresh(PhaseClock& clock) {
    direct_->allow_approximation();
    fresh_ = direct_->factorize(*matrix_, clock);
    size_ = fresh_ ? matrix_->size() : 0;
    stale_ = false;
    return fresh_;
  }

  enum class Outcome { solved, too_slow, indefinite };

  Outcome iterate(const VecX& b, VecX& x, PhaseClock& clock) {
    x.setZero(b.size());
    residual_ = b;
    direct_->solve(residual_, z_, clock);
    direction_ = z_;
    double rz = residual_.dot(z_);
    const double goal = tolerance_ * tolerance_ * rz;
    for (int i = 0; i < max_iterations_; ++i) {
      if (!(rz > goal)) {
        stale_ = i > max_iterations_ / 2;
        return Outcome::solved;
      }
      {
        const PhaseScope scope(clock, Phase::solve);
        operator_.multiply(*matrix_, direction_, product_);
      }
      const double curvature = direction_.dot(product_);
      if (!(curvature > 0)) return Outcome::indefinite;
      const double step = rz / curvature;
      x += step * direction_;
      residual_ -= step * product_;
      direct_->solve(residual_, z_, clock);
      const double next = residual_.dot(z_);
      direction_ = z_ + next / rz * direction_;
      rz = next;
    }
    return Outcome::too_slow;
  }

  std::unique_ptr<LinearSolver> direct_ = Registry<LinearSolver>::make("multifrontal");
  double tolerance_ = 0.03;
  int max_iterations_ = 12;

  const BlockMatrix* matrix_ = nullptr;
  int size_ = 0;        // of the factor; 0: there is none
  bool fresh_ = false;  // the factor is that of matrix_
  bool stale_ = false;  // the last solve took so long that the next deserves a new factor
  SymmetricProduct operator_;
  VecX residual_, z_, direction_, product_;
};

TACK_REGISTER(LinearSolver, LaggedCholesky, "lagged_cholesky",
              "Conjugate gradients preconditioned by an earlier Cholesky factor.",
              "Nocedal and Wright, Numerical Optimization, 5.1 (preconditioned conjugate gradients)");

}  // namespace tack
