// The systems of Newton steps, H p = -g. Factorises a Hessian that may be semi-definite (free rigid
// motions of a quasi-static body) or, without a projection, indefinite: its diagonal gets a shift
// that grows until the factorisation runs through and the direction p = -H^-1 g is finite and
// descends.
#pragma once

#include <optional>

#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"

namespace tack {

// p <- -H^-1 g; false if H cannot be factorised or p is not finite. Counts as a linear solve.
bool newton_solve(LinearSolver& linear, const BlockMatrix& hessian, const VecX& gradient, VecX& p,
                  PhaseClock& clock, MinimizerResult& result);

// p <- -(H + shift)^-1 g. The shift, in units of the largest diagonal entry: 0 if H itself would
// do, and nothing if even a shift of 100 fails. A shifted direction is short: its length says
// little about how far the minimum is.
std::optional<double> shifted_solve(LinearSolver& linear, const BlockMatrix& hessian,
                                    const VecX& gradient, VecX& p, PhaseClock& clock,
                                    MinimizerResult& result);

}  // namespace tack
