// Some stencils of a term that has no restricted form: the term is evaluated as a whole, at the
// configuration of all vertices, and the chosen stencils are taken out.
#pragma once

#include <memory>

#include "framework/core/global_modes.hpp"
#include "framework/core/local_stencils.hpp"
#include "framework/core/term.hpp"

namespace tack {

/// Returns the chosen stencils of a term, with its global modes. x: the configuration of all
/// vertices (3n) at the next evaluation, whatever configuration that is called with. whole and x
/// must outlive the result.
std::unique_ptr<Term> listed_stencils(const Term& whole, const StencilChoice& choice,
                                      const VecX& x);

}  // namespace tack
