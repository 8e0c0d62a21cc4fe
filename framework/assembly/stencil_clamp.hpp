// Clamps Hessians of stencils in their slots (see Term): negative eigenvalues become zero. Every stencil feels only
// relative motion.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/term.hpp"

namespace tack {

// Those of the stencils first .. last - 1 of a batch that touch an unknown block with a flag. slots: of `first` and on.
void clamp_stencils(const StencilBatch& batch, int first, int last, const std::vector<char>& flags, const DofMap& dofs,
                    double* slots);

// A Hessian of three vertices and two twists, the one kind of stencil that has some (StencilBatch).
void project_twisted_slots(double* slots, Projection projection);

}  // namespace tack
