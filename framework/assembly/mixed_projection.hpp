// Projection of the Hessian of a stencil of places and numbers (StencilBatch) onto the positive semi-definite cone.
#pragma once

#include "framework/core/projection.hpp"

namespace tack {

// The last `numbers` of its vertices are one number each, first of three. In what is orthogonal to translations of the others, in its slots
// (core/term.hpp).
void project_mixed_psd(int arity, int numbers, double* slots, Projection projection);

}  // namespace tack
