// y = A x for a symmetric block matrix stored by its lower triangle, parallel over rows: each row
// sums its own blocks and, transposed, those of its column, so that threads never share a result.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

class SymmetricProduct {
 public:
  void multiply(const BlockMatrix& matrix, const VecX& x, VecX& y);

 private:
  void index_rows(const BlockMatrix& matrix);

  std::uint64_t version_ = 0;
  int columns_ = -1;
  std::vector<int> row_start_;  // strictly lower blocks by row
  std::vector<int> block_, column_;
};

}  // namespace tack
