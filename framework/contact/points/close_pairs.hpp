// Close pairs of primitives at a configuration (MinimizerProblem::pairs).
#pragma once

#include <vector>

#include "framework/contact/contact_system.hpp"
#include "framework/core/close_pair.hpp"

namespace tack {

// Returns the pairs at x (3n) whose gap is below `reach` [m], sorted by kind and vertices, without
// their bodies. Pairs that do not touch each other, neighbours and those at rest within the offset
// included, are not among them. Throws InputError if `reach` is larger than the largest range of
// contact, within which alone pairs are searched.
std::vector<ClosePair> close_pairs(ContactSystem& contact, const VecX& x, double reach);

}  // namespace tack
