// The system of a Newton step, H p = -g, with an H that may be singular.
#pragma once

#include "framework/core/linear_solver.hpp"
#include "framework/core/minimizer.hpp"

namespace tack {

// A semi-definite H (free rigid motions of a quasi-static body) gets a growing shift. False if none did.
bool solve_newton_system(LinearSolver& linear, const BlockMatrix& hessian, const VecX& gradient, VecX& p,
                         PhaseClock& clock, MinimizerResult& result);

}  // namespace tack
