// The exact Hessian at the end of steps, to solve for the change of these ends:
//     H dx = gradient - gradient of the perturbed scene
// The Hessian of an earlier step is reused until the caller's corrections converge too slowly. It
// is evaluated with the potential of the perturbed scene, which differs negligibly, so that no
// state of the run changes.
#pragma once

#include <Eigen/SparseCholesky>

#include <memory>

#include "framework/core/linear_solver.hpp"
#include "framework/core/mode_update.hpp"
#include "framework/core/symmetric_product.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

class TangentSystem {
 public:
  explicit TangentSystem(PhaseClock& clock) : clock_(clock) {}

  // Begins a solved step; its constrained dofs may differ from those of the last step.
  void begin(const SolvedStep& step);
  // Begins another solve of the same step, with other lagged friction.
  void begin_solve() { current_ = false; }
  // Evaluates and factorises the Hessian at the present state of a potential.
  void refresh(StepPotential& potential);
  bool is_current() const { return current_; }  // the Hessian is of the present solve
  bool has_factor() const { return factored_; }
  // Returns true if some displacement is nearly unconstrained: its size is then only rounding.
  bool nearly_singular() const { return is_shifted_ && shift_ > 0; }
  // Solves d <- H^-1 r.
  void solve(const VecX& r, VecX& d);
  // Discards the Hessian.
  void forget() { factored_ = current_ = false; }

  int factors() const { return factors_; }
  // Number of indefinite Hessians among them: steps that ended in an unstable equilibrium.
  int indefinite() const { return indefinite_; }

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  bool factorize(double shift);
  void factorize_indefinite();
  bool correct(const VecX& r, VecX& d);

  PhaseClock& clock_;
  int unknowns_ = -1;
  bool inertia_ = true;
  BlockMatrix matrix_, shifted_;  // the Hessian, and its shifted copy
  SymmetricProduct product_;
  std::unique_ptr<LinearSolver> definite_;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower> ldlt_;  // of an indefinite Hessian
  ModeUpdate update_;                                 // of the Hessian's blocks
  bool factored_ = false, current_ = false, positive_ = true, is_shifted_ = false;
  size_t shift_ = 0;
  int factors_ = 0, indefinite_ = 0;
};

}  // namespace tack
