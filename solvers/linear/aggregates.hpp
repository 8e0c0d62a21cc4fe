// Pieces of bodies: vertices of one part of a system (BlockMatrix::part) that are coupled, side by side. Where they lie in a plane or
// on a line, as in sheets and rods, a piece is small: what bends there is as soft as a solid over the same number of vertices across.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

struct Aggregates {
  // Needs `place` and `part` of the matrix. Depends on these and on its pattern alone.
  void build(const BlockMatrix& matrix);

  int count() const { return static_cast<int>(start.size()) - 1; }

  std::vector<int> of;         // of each column; -1: its part is too small to be cut
  std::vector<int> start{0};   // of each piece's columns, one more
  std::vector<int> column;     // ascending within a piece
};

}  // namespace tack
