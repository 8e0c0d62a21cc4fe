// The gradient of one term at every vertex, fixed ones included: for records, not for solving.
#pragma once

#include "framework/core/term.hpp"

namespace tack {

// Adds the term's gradient (3n) [N].
void add_term_gradient(const Term& term, const VecX& x, VecX& gradient);
// That of its stencils alone: without what it adds by add_linear_gradient().
void add_stencil_gradient(const Term& term, const VecX& x, VecX& gradient);

}  // namespace tack
