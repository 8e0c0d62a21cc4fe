// The exact Hessian of steps where they end, to solve for what their ends change by: H dx = gradient - gradient of the scene beside.
// It is taken anew only when that of an earlier step serves no longer, which those who solve find by how fast they converge; from the
// potential of the scene beside, which differs by next to nothing, so that nothing of the run is touched.
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

  // A step is solved; what is held may be others than in the last one.
  void begin(const SolvedStep& step);
  // Another solve of that step, in which friction held something else.
  void begin_solve() { fresh_ = false; }
  // Takes the Hessian where a potential is.
  void refresh(StepPotential& potential);
  bool present() const { return fresh_; }  // that of the present solve
  bool known() const { return factored_; }
  // Something is held by next to nothing: how far it goes is only rounding.
  bool loose() const { return is_shifted_ && shift_ > 0; }
  // d <- H^-1 r
  void solve(const VecX& r, VecX& d);
  // As if none had been made yet.
  void forget() { factored_ = fresh_ = false; }

  int factors() const { return factors_; }
  int indefinite() const { return indefinite_; }  // of them: of steps that ended where nothing is stable

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  bool factorize(double shift);
  void take_as_it_is();
  bool correct(const VecX& r, VecX& d);

  PhaseClock& clock_;
  int unknowns_ = -1;
  bool inertia_ = true;
  BlockMatrix matrix_, shifted_;  // the Hessian, and what is factorised where it may be singular
  SymmetricProduct product_;
  std::unique_ptr<LinearSolver> definite_;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower> ldlt_;  // of what is not positive definite
  ModeUpdate update_;  // of its blocks
  bool factored_ = false, fresh_ = false, positive_ = true, is_shifted_ = false;
  size_t shift_ = 0;
  int factors_ = 0, indefinite_ = 0;
};

}  // namespace tack
