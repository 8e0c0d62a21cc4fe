// How far a Newton direction p, H p = -g, may be believed. Solvers that iterate leave a residual, and what they
// left out may be just what keeps a point from being the minimum: where it is small against |g|, it may be the
// whole motion of a body that falls freely beside a stiff contact. So where p would end the minimisation,
// its residual is taken, and p is corrected until its stopping norm and a bound of what it still misses are below 1
// together, or the norm of the better p no longer is. For a direct solver that is one product.
#pragma once

#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/core/symmetric_product.hpp"

namespace tack {

class DirectionCheck {
 public:
  // The stopping norm of p; where that is not above 1, a bound of the exact direction's: still above 1 if the
  // solver cannot make p good enough. `linear` must have factorised `hessian`; p may change.
  double norm(LinearSolver& linear, const BlockMatrix& hessian, const MinimizerProblem& problem, VecX& p,
              MinimizerResult& result);

 private:
  SymmetricProduct product_;
  VecX residual_, correction_;
};

}  // namespace tack
