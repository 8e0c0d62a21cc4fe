// Error control of a Newton direction p, H p = -g. Iterative solvers leave a residual. A residual
// that is small against |g| may hold the whole motion of a body that falls freely beside a stiff
// contact. Therefore, if p would end the minimisation, p is corrected until:
//     stopping norm of p + bound of the norm of its error < 1, or
//     the norm of the corrected p is above 1.
// A direct solver needs one product for this check.
#pragma once

#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/core/symmetric_product.hpp"

namespace tack {

class DirectionCheck {
 public:
  // Returns the stopping norm of p, or, if that is not above 1, a bound of the exact direction's
  // norm; above 1 if the solver cannot make p good enough. `linear` must have factorised `hessian`.
  // Changes p.
  double norm(LinearSolver& linear, const BlockMatrix& hessian, const MinimizerProblem& problem,
              VecX& p, MinimizerResult& result);

 private:
  SymmetricProduct product_;
  VecX residual_, correction_;
};

}  // namespace tack
