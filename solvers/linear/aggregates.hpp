// Aggregates: connected groups of neighbouring vertices of one component of a system
// (BlockMatrix::component). Groups in a plane or on a line (sheets, rods) are small, because
// bending makes them as soft as a solid over the same number of vertices across.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

struct Aggregates {
  // Builds the groups from the pattern, `positions` and `component` of the matrix, which must be
  // there.
  void build(const BlockMatrix& matrix);

  int count() const { return static_cast<int>(start.size()) - 1; }

  std::vector<int> of;        // group of each column; -1: its component is too small to be divided
  std::vector<int> start{0};  // first index in `column` of each group, and the end
  std::vector<int> column;    // ascending within a group
};

}  // namespace tack
