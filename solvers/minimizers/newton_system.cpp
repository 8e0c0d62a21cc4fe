#include "solvers/minimizers/newton_system.hpp"

#include <algorithm>

namespace tack {

bool solve_newton_system(LinearSolver& linear, const BlockMatrix& hessian, const VecX& gradient, VecX& p,
                         PhaseClock& clock, MinimizerResult& result) {
  const auto solve = [&](const BlockMatrix& matrix) {
    ++result.linear_solves;
    if (!linear.factorize(matrix, clock)) return false;
    linear.solve(-gradient, p, clock);
    return p.allFinite();
  };
  if (solve(hessian)) return true;
  BlockMatrix shifted = hessian;
  double largest = 0;
  for (int c = 0; c < shifted.columns(); ++c)
    largest = std::max(largest, shifted.block(shifted.column_start[c]).diagonal().maxCoeff());
  for (double shift = 1e-10; shift <= 1; shift *= 100) {
    for (int c = 0; c < shifted.columns(); ++c)
      shifted.block(shifted.column_start[c]).diagonal() =
          hessian.block(shifted.column_start[c]).diagonal().array() + shift * largest;
    if (solve(shifted)) return true;
  }
  return false;
}

}  // namespace tack
