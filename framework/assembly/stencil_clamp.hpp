// Clamps the Hessian of one stencil in its slots (see Term), whatever its arity.
#pragma once

namespace tack {

// Negative eigenvalues become zero. Every stencil feels only relative motion.
void clamp_stencil(int arity, double* slots);

}  // namespace tack
