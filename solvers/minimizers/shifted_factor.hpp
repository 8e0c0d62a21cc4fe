// Systems of Newton steps, H p = -g, for a Hessian that may be semi-definite (free rigid motions of
// a quasi-static body) or, without projection, indefinite. A shift of the diagonal grows until the
// factorisation succeeds and p = -H^-1 g is finite and descends.
#pragma once

#include <optional>

#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"

namespace tack {

// The first shift that is tried, in units of the largest diagonal entry: far above the round-off of
// a factorisation, far below the stiffness of any deformation.
inline constexpr double smallest_shift = 1e-10;

// p <- -H^-1 g. Returns false if H cannot be factorised or p is not finite. Counts as a linear
// solve.
bool newton_solve(LinearSolver& linear, const BlockMatrix& hessian, const VecX& gradient, VecX& p,
                  PhaseClock& clock, MinimizerResult& result);

// p <- -(H + shift)^-1 g. Returns the shift in units of the largest diagonal entry, 0 if H needs
// none, and nothing if even a shift of 100 fails. A shifted direction is short: its length does not
// measure the distance to the minimum.
std::optional<double> shifted_solve(LinearSolver& linear, const BlockMatrix& hessian,
                                    const VecX& gradient, VecX& p, PhaseClock& clock,
                                    MinimizerResult& result);

}  // namespace tack
