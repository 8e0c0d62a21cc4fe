// Base of solvers that factorise the blocks of a matrix. Global modes of the matrix enter by
// low-rank correction (mode_update.hpp): one solve per mode after a factorisation, and one product
// per mode in every solve.
#pragma once

#include "framework/core/linear_solver.hpp"
#include "framework/core/mode_update.hpp"

namespace tack {

/// Base of direct solvers, which implement factorize_blocks() and solve_blocks().
class DirectSolver : public LinearSolver {
 public:
  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) final {
    update_.clear();
    return factorize_blocks(matrix, clock) &&
           update_.prepare(matrix.modes,
                           [&](const VecX& b, VecX& x) { solve_blocks(b, x, clock); });
  }
  void solve(const VecX& b, VecX& x, PhaseClock& clock) final {
    solve_blocks(b, x, clock);
    update_.apply(x);
  }
  void solve_columns(Eigen::MatrixXd& columns, PhaseClock& clock) final {
    solve_block_columns(columns, clock);
    if (update_.empty()) return;
    VecX x;
    for (Eigen::Index i = 0; i < columns.cols(); ++i) {
      x = columns.col(i);
      update_.apply(x);
      columns.col(i) = x;
    }
  }

 protected:
  /// Counterparts of LinearSolver's functions for the blocks alone, without global modes.
  virtual bool factorize_blocks(const BlockMatrix& matrix, PhaseClock& clock) = 0;
  virtual void solve_blocks(const VecX& b, VecX& x, PhaseClock& clock) = 0;
  virtual void solve_block_columns(Eigen::MatrixXd& columns, PhaseClock& clock) {
    VecX x;
    for (Eigen::Index i = 0; i < columns.cols(); ++i) {
      solve_blocks(columns.col(i), x, clock);
      columns.col(i) = x;
    }
  }

 private:
  ModeUpdate update_;
};

}  // namespace tack
