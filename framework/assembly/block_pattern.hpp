// Sparsity of the assembled Hessian: the union of the blocks of static stencils (fixed for a run)
// and of dynamic stencils (contact). Blocks that contact used recently stay in the pattern as
// explicit zeros, so that the symbolic analysis of a solver survives pairs that come and go.
//
// Lists of blocks are sorted by column, so that a run of columns is a range of each list. Unions
// are made in parallel over such runs.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

// A block (row, column) as one sortable key: column first, rows ascending within a column.
using BlockKey = std::uint64_t;
/// Returns the key of a block.
inline BlockKey block_key(int row, int column) {
  return (static_cast<BlockKey>(static_cast<std::uint32_t>(column)) << 32) |
         static_cast<std::uint32_t>(row);
}
/// Returns the row of a key.
inline int key_row(BlockKey key) { return static_cast<int>(key & 0xffffffffu); }
/// Returns the column of a key.
inline int key_column(BlockKey key) { return static_cast<int>(key >> 32); }

/// Blocks of the assembled Hessian.
class BlockPattern {
 public:
  // Sorted unique keys of the static stencils; diagonal blocks are always added.
  BlockPattern(int columns, const std::vector<BlockKey>& static_keys);

  /// Adds missing dynamic keys (sorted, unique) to the matrix and finds their positions there.
  /// Returns true if the structure of the matrix changed; its values are then undefined.
  bool cover(const std::vector<BlockKey>& dynamic_keys, BlockMatrix& matrix,
             std::vector<int>& positions);

  /// Returns the position in the matrix of static key k.
  const std::vector<int>& static_positions() const { return static_positions_; }
  const std::vector<BlockKey>& static_keys() const { return static_keys_; }

 private:
  void rebuild(BlockMatrix& matrix);

  int columns_;
  std::vector<BlockKey> static_keys_;
  std::vector<BlockKey> extra_keys_;  // dynamic blocks at present in the pattern
  std::vector<int> static_positions_;
};

}  // namespace tack
