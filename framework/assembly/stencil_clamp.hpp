// Projects Hessians of stencils in their slots (see Term) onto the positive semi-definite cone, in what every stencil feels: relative motion,
// and numbers.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/term.hpp"

namespace tack {

// Those of the stencils first .. last - 1 of a batch that touch an unknown block with a flag. slots: of `first` and on.
void clamp_stencils(const StencilBatch& batch, int first, int last, const std::vector<char>& flags, const DofMap& dofs,
                    double* slots);

// One Hessian, of a stencil of such a batch (whose vertices are not looked at).
void project_slots(const StencilBatch& kind, double* slots, Projection projection);

}  // namespace tack
