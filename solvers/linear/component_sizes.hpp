// Sizes of the components of a system (BlockMatrix::part), for coarse spaces of preconditioners.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

// Vertices; incomplete factors solve smaller components nearly as well as a complete factor.
inline constexpr int smallest_part = 24;

// Returns the number of columns of each component.
inline std::vector<int> component_sizes(const BlockMatrix& matrix) {
  std::vector<int> sizes(
      matrix.component.empty() ? 0 : *std::max_element(matrix.component.begin(), matrix.component.end()) + 1, 0);
  for (const int part : matrix.component) ++sizes[part];
  return sizes;
}

}  // namespace tack
