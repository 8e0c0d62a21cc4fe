// The lower triangle of a block matrix by rows; the matrix has it by columns.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

struct LowerRows {
  void build(const BlockMatrix& matrix);

  int size() const { return row_start.empty() ? 0 : static_cast<int>(row_start.size()) - 1; }
  int diagonal(int row) const { return row_start[row + 1] - 1; }

  std::vector<int> row_start;  // first entry of each row, and the end
  std::vector<int> column;     // of each entry of a row, ascending: the diagonal comes last
  std::vector<int> block;      // of the matrix, of each entry
  std::vector<int> entry;      // of each block of the matrix
};

}  // namespace tack
