// The gradient of one term at every vertex, fixed ones included: for records, not for solving.
#pragma once

#include <functional>
#include <span>

#include "framework/core/term.hpp"

namespace tack {

/// Adds the gradient of the term (3n) [N].
void add_term_gradient(const Term& term, const VecX& x, VecX& gradient);
/// Adds the gradient of the stencils alone (3n) [N], without add_linear_gradient().
/// counts: whether a stencil counts, by its global vertices; empty: all do.
void add_stencil_gradient(const Term& term, const VecX& x, VecX& gradient,
                          const std::function<bool(std::span<const int>)>& counts = {});

}  // namespace tack
