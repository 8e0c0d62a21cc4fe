// Symmetric sparse matrix of 3x3 blocks plus global modes. Storage: lower triangle by block
// columns, rows ascending, the diagonal block first. Only the owner of the pattern changes the
// structure; a new `version` makes solvers repeat their symbolic analysis.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/core/global_modes.hpp"

namespace tack {

/// The blocks of the lower triangle, and the global modes.
struct BlockMatrix {
  std::vector<int> column_start;  // block columns + 1
  std::vector<int> row;           // block row of each block, >= its column
  std::vector<double> values;     // 9 per block, column major
  std::uint64_t version = 0;      // changes with column_start or row
  VecX positions;                 // 3 per block column: of its vertex [m]; may be empty
  std::vector<int> component;     // per block column: connected by lasting stencils; may be empty
  GlobalModes modes;              // low-rank summands outside the blocks; usually none

  int columns() const {
    return column_start.empty() ? 0 : static_cast<int>(column_start.size()) - 1;
  }
  int size() const { return 3 * columns(); }
  int blocks() const { return static_cast<int>(row.size()); }
  auto block(int k) { return Eigen::Map<Mat3>(values.data() + 9 * static_cast<std::ptrdiff_t>(k)); }
  auto block(int k) const {
    return Eigen::Map<const Mat3>(values.data() + 9 * static_cast<std::ptrdiff_t>(k));
  }

  /// Position of block (r, c), r >= c, or -1.
  int find(int r, int c) const;
  /// y = A x with the full symmetric matrix.
  void multiply(const VecX& x, VecX& y) const;
};

}  // namespace tack
