// Sizes of the components of a system (BlockMatrix::component), for coarse spaces of
// preconditioners.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

// Number of vertices. Incomplete factors solve smaller components nearly as well as a complete
// factor.
inline constexpr int smallest_component = 24;

// Returns the number of columns of each component.
inline std::vector<int> component_sizes(const BlockMatrix& matrix) {
  const std::vector<int>& all = matrix.component;
  std::vector<int> sizes(all.empty() ? 0 : *std::max_element(all.begin(), all.end()) + 1, 0);
  for (const int c : all) ++sizes[c];
  return sizes;
}

}  // namespace tack
