// Check of a Newton direction p, H p = -g. Iterative solvers leave a residual, and a residual that
// is small against |g| may hide what keeps a point from being the minimum, such as the free fall of
// a body beside a stiff contact. Where p would end the minimisation, its residual is computed, and
// p is corrected until the sum of its convergence norm and a bound of the remaining error is below
// 1, or the norm of the corrected p is above 1. For a direct solver that is one product.
#pragma once

#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/core/symmetric_product.hpp"

namespace tack {

class DirectionCheck {
 public:
  // The stopping norm of p; where that is not above 1, a bound of the exact direction's: still
  // above 1 if the solver cannot make p good enough. `linear` must have factorised `hessian`; p may
  // change.
  double norm(LinearSolver& linear, const BlockMatrix& hessian, const MinimizerProblem& problem,
              VecX& p, MinimizerResult& result);

 private:
  SymmetricProduct product_;
  VecX residual_, correction_;
};

}  // namespace tack
