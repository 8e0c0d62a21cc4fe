// Projects Hessians of stencils in their slots (Term) onto the positive semi-definite cone, in the
// space of relative motion and scalar dofs.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/term.hpp"

namespace tack {

/// Clamps the stencils first .. last - 1 of a batch that touch a flagged block of unknowns. slots:
/// from those of `first` on.
void clamp_stencils(const StencilBatch& batch, int first, int last, const std::vector<char>& flags,
                    const DofMap& dofs, double* slots);

/// Clamps one Hessian, of a stencil of such a batch (its vertices are not read).
void project_slots(const StencilBatch& kind, double* slots, Projection projection);

}  // namespace tack
