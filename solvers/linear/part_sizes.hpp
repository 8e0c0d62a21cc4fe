// The parts of a system (BlockMatrix::part) that are worth a coarse space of a preconditioner.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

inline constexpr int smallest_part = 24;  // vertices: incomplete factors solve what is smaller nearly as well as a whole one

// The columns of each.
inline std::vector<int> part_sizes(const BlockMatrix& matrix) {
  std::vector<int> sizes(matrix.part.empty() ? 0 : *std::max_element(matrix.part.begin(), matrix.part.end()) + 1, 0);
  for (const int part : matrix.part) ++sizes[part];
  return sizes;
}

}  // namespace tack
