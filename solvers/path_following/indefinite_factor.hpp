// LDL^T factor of a symmetric matrix that may be indefinite: the exact Hessian of an unstable
// equilibrium. Its negative pivots count the unstable modes (Sylvester's law of inertia). Without
// pivoting; a zero pivot, as at a limit point that is met exactly, is a failed factorisation.
#pragma once

#include <Eigen/SparseCholesky>

#include "framework/core/phase_clock.hpp"
#include "solvers/linear/scalar_csc.hpp"

namespace tack {

class IndefiniteFactor {
 public:
  // Factorises A. Returns false if a pivot is zero. Throws SimulationError if A has global modes.
  bool factorize(const BlockMatrix& matrix, PhaseClock& clock);
  // Returns A^-1 b with the last factor.
  VecX solve(const VecX& b, PhaseClock& clock) const;
  int negative_pivots() const { return negative_pivots_; }

 private:
  ScalarCsc csc_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
  std::uint64_t version_ = 0;
  int negative_pivots_ = 0;
};

}  // namespace tack
