#include "framework/core/block_matrix.hpp"

#include <algorithm>

namespace tack {

int BlockMatrix::find(int r, int c) const {
  const auto first = row.begin() + column_start[c];
  const auto last = row.begin() + column_start[c + 1];
  const auto it = std::lower_bound(first, last, r);
  return it != last && *it == r ? static_cast<int>(it - row.begin()) : -1;
}

void BlockMatrix::multiply(const VecX& x, VecX& y) const {
  y.setZero(size());
  for (int c = 0; c < columns(); ++c) {
    for (int k = column_start[c]; k < column_start[c + 1]; ++k) {
      const int r = row[k];
      y.segment<3>(3 * r) += block(k) * x.segment<3>(3 * c);
      if (r != c) y.segment<3>(3 * c) += block(k).transpose() * x.segment<3>(3 * r);
    }
  }
  add_product(modes, x, y);
}

}  // namespace tack
