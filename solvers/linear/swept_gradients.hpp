// Preconditioned conjugate gradients by sweeps of a matrix (matrix_sweeps.hpp), with an optional
// low-rank addition to the preconditioner. Norm, outcomes and order of sums are those of
// conjugate_gradients.hpp; products, preconditioner, updates and sums share two passes through the
// matrix.
#pragma once

#include "solvers/linear/conjugate_gradients.hpp"
#include "solvers/linear/matrix_sweeps.hpp"

namespace tack {

class SweptGradients {
 public:
  using Outcome = ConjugateGradients::Outcome;
  using Goal = ConjugateGradients::Goal;

  // Solves A x = b from x = 0. add(r, z): adds the low-rank part of M^-1 r to z and returns its
  // product with r.
  template <class Add>
  Outcome solve(MatrixSweeps& sweeps, const VecX& b, VecX& x, Goal goal, PhaseClock& clock,
                const Add& add) {
    residual_ = b;
    sweeps.begin();
    last_ = 0;
    return iterate(sweeps, x, goal, clock, add);
  }
  // Continues for the residual b that the last solve with this matrix left; directions stay
  // conjugate to the earlier ones.
  template <class Add>
  Outcome go_on(MatrixSweeps& sweeps, const VecX& b, VecX& x, Goal goal, PhaseClock& clock,
                const Add& add) {
    residual_ = b;
    return iterate(sweeps, x, goal, clock, add);
  }
  void clear() { last_ = 0; }  // the matrix has changed
  // Returns true if b is the residual of the last solve, up to rounding.
  bool left(const VecX& b) const {
    return last_ > 0 && b.size() == residual_.size() &&
           (b - residual_).squaredNorm() <= same * residual_.squaredNorm();
  }

  int iterations() const { return iterations_; }  // of the last solve

 private:
  static constexpr double same = 1e-4;  // relative difference, squared

  template <class Add>
  Outcome iterate(MatrixSweeps& sweeps, VecX& x, Goal goal, PhaseClock& clock, const Add& add) {
    const PhaseScope scope(clock, Phase::solve);
    x.setZero(residual_.size());
    more_.resize(residual_.size());
    double enough = 0, step = 0;
    for (iterations_ = 0;; ++iterations_) {
      more_.setZero();
      double rz = sweeps.forward(step, x, residual_);
      rz += add(residual_, more_);
      if (iterations_ == 0) enough = goal.tolerance * goal.tolerance * rz;
      if (!(rz > enough)) return rz >= 0 ? Outcome::solved : Outcome::misled;
      if (iterations_ == goal.max_iterations) return Outcome::too_slow;
      clock.deadline().check();
      const double curvature = sweeps.backward(last_ > 0 ? rz / last_ : 0, more_);
      last_ = rz;
      if (!(curvature > 0)) {
        last_ = 0;
        return curvature <= 0 ? Outcome::indefinite : Outcome::misled;
      }
      step = rz / curvature;
    }
  }

  VecX residual_, more_;
  double last_ = 0;  // r . M^-1 r of the last direction; 0: none
  int iterations_ = 0;
};

}  // namespace tack
