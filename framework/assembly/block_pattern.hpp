// The sparsity of the assembled Hessian: the union of what the static stencils touch (fixed for a
// run) and what the dynamic ones (contact) touch. Blocks that contact needed recently stay in the
// pattern as explicit zeros, so that a solver's symbolic analysis survives pairs that come and go.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

// A block (row, column) as one sortable key: column first, rows ascending within a column.
using BlockKey = std::uint64_t;
inline BlockKey block_key(int row, int column) {
  return (static_cast<BlockKey>(static_cast<std::uint32_t>(column)) << 32) |
         static_cast<std::uint32_t>(row);
}
inline int key_row(BlockKey key) { return static_cast<int>(key & 0xffffffffu); }
inline int key_column(BlockKey key) { return static_cast<int>(key >> 32); }

class BlockPattern {
 public:
  // Sorted unique keys of the static stencils; diagonal blocks are always added.
  BlockPattern(int columns, std::vector<BlockKey> static_keys);

  // Makes sure that every dynamic key (sorted, unique) is in the matrix and finds their positions
  // there. Returns true if its structure had to change.
  bool cover(const std::vector<BlockKey>& dynamic_keys, BlockMatrix& matrix, std::vector<int>& positions);

  // Position in the matrix of the k-th static key.
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
