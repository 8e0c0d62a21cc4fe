#include "solvers/minimizers/shifted_factor.hpp"

#include <algorithm>

namespace tack {
namespace {

constexpr double shifts[] = {smallest_shift, 1e-8, 1e-6, 1e-4, 1e-2, 0.1, 0.5, 2, 10, 100};

double largest_diagonal(const BlockMatrix& matrix) {
  double largest = 0;
  for (int c = 0; c < matrix.columns(); ++c)
    largest = std::max(largest, matrix.block(matrix.column_start[c]).diagonal().cwiseAbs().maxCoeff());
  return largest;
}

}  // namespace

bool newton_solve(LinearSolver& linear, const BlockMatrix& hessian, const VecX& gradient, VecX& p,
                  PhaseClock& clock, MinimizerResult& result) {
  ++result.linear_solves;
  if (!linear.factorize(hessian, clock)) return false;
  linear.solve(-gradient, p, clock);
  result.linear_iterations += linear.iterations();
  return p.allFinite();
}

std::optional<double> shifted_solve(LinearSolver& linear, const BlockMatrix& hessian, const VecX& gradient, VecX& p,
                   PhaseClock& clock, MinimizerResult& result) {
  const auto solved = [&](const BlockMatrix& matrix) {
    return newton_solve(linear, matrix, gradient, p, clock, result) && !(p.dot(gradient) > 0);
  };
  if (solved(hessian)) return 0.0;
  BlockMatrix shifted = hessian;
  const double largest = largest_diagonal(hessian);
  for (const double shift : shifts) {
    for (int c = 0; c < shifted.columns(); ++c)
      shifted.block(shifted.column_start[c]).diagonal() =
          hessian.block(shifted.column_start[c]).diagonal().array() + shift * largest;
    if (solved(shifted)) return shift;
  }
  return std::nullopt;
}

}  // namespace tack
