// LDL^T factor of a symmetric matrix that may be indefinite: the exact Hessian of an unstable
// equilibrium. Its negative pivots count the unstable modes (Sylvester's law of inertia). Without
// pivoting; a zero pivot, as at a limit point that is met exactly, is a failed factorisation.
#pragma once

#include "solvers/linear/simplicial_factor.hpp"

namespace tack {

class IndefiniteFactor {
 public:
  // Factorises A. Returns false if a pivot is zero. Throws SimulationError if A has global modes.
  bool factorize(const BlockMatrix& matrix, PhaseClock& clock);
  // Returns A^-1 b with the last factor.
  VecX solve(const VecX& b, PhaseClock& clock) const { return factor_.solve(b, clock); }
  int negative_pivots() const { return negative_pivots_; }

 private:
  SimplicialFactor factor_;
  int negative_pivots_ = 0;
};

}  // namespace tack
