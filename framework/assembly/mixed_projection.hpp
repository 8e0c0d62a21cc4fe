// Projection of the Hessian of a stencil of positions and scalar dofs (StencilBatch) onto the
// positive semi-definite cone.
#pragma once

#include "framework/core/projection.hpp"

namespace tack {

/// Projects in the space orthogonal to translations of the positions. The last `scalars` vertices
/// are scalar dofs, the first of three entries. Slots: core/term.hpp.
void project_mixed_psd(int arity, int scalars, double* slots, Projection projection);

}  // namespace tack
