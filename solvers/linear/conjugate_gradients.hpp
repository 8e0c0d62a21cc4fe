// Preconditioned conjugate gradients, A x = b from x = 0: the loop of all iterative solvers. The
// residual norm is sqrt(r . M^-1 r), which weights a stiff contact like everything else. Sums run
// in chunk order, for the same bits with any number of threads.
#pragma once

#include "framework/core/phase_clock.hpp"
#include "framework/core/symmetric_product.hpp"

namespace tack {

class ConjugateGradients {
 public:
  // indefinite: A is indefinite along some direction; misled: the preconditioner is not positive
  // definite.
  enum class Outcome { solved, too_slow, indefinite, misled };
  struct Goal {
    double tolerance;    // residual, relative to that of x = 0
    int max_iterations;  // products with A
  };

  // Solves A x = b. precondition(r, z): z <- M^-1 r. If the outcome is not `solved`, x is the best
  // point of the Krylov space so far, a descent direction of 1/2 x.A x - x.b unless it is zero.
  // Throws OutOfTime.
  template <class Precondition>
  Outcome solve(const BlockMatrix& matrix, const VecX& b, VecX& x, Goal goal, PhaseClock& clock,
                const Precondition& precondition);

  int iterations() const { return iterations_; }  // of the last solve

 private:
  double dot(const VecX& a, const VecX& b);
  // x <- x + step d, r <- r - step A d.
  void advance(double step, VecX& x);
  // d <- z + ratio d.
  void turn(double ratio);

  SymmetricProduct operator_;
  VecX residual_, z_, direction_, product_;
  std::vector<double> partial_;
  int iterations_ = 0;
};

template <class Precondition>
ConjugateGradients::Outcome ConjugateGradients::solve(const BlockMatrix& matrix, const VecX& b,
                                                      VecX& x, Goal goal, PhaseClock& clock,
                                                      const Precondition& precondition) {
  x.setZero(b.size());
  residual_ = b;
  precondition(residual_, z_);
  const PhaseScope scope(clock, Phase::solve);
  direction_ = z_;
  double rz = dot(residual_, z_);
  const double enough = goal.tolerance * goal.tolerance * rz;
  for (iterations_ = 0; rz > enough; ++iterations_) {
    if (iterations_ == goal.max_iterations) return Outcome::too_slow;
    clock.deadline().check();
    operator_.multiply(matrix, direction_, product_);
    const double curvature = dot(direction_, product_);
    if (!(curvature > 0)) return curvature <= 0 ? Outcome::indefinite : Outcome::misled;
    advance(rz / curvature, x);
    precondition(residual_, z_);
    const double next = dot(residual_, z_);
    turn(next / rz);
    rz = next;
  }
  // False for a preconditioner that is not positive definite, or a right side that is not finite.
  return rz >= 0 ? Outcome::solved : Outcome::misled;
}

}  // namespace tack
