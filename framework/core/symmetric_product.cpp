#include "framework/core/symmetric_product.hpp"

#include "framework/assembly/parallel.hpp"
#include "framework/core/lanes.hpp"

namespace tack {
void SymmetricProduct::index_rows(const BlockMatrix& matrix) {
  columns_ = matrix.columns();
  version_ = matrix.version;
  row_start_.assign(columns_ + 1, 0);
  for (int c = 0; c < columns_; ++c)
    for (int k = matrix.column_start[c] + 1; k < matrix.column_start[c + 1]; ++k)
      ++row_start_[matrix.row[k] + 1];
  for (int r = 0; r < columns_; ++r) row_start_[r + 1] += row_start_[r];
  block_.resize(row_start_.back());
  column_.resize(row_start_.back());
  auto next = row_start_;
  for (int c = 0; c < columns_; ++c) {
    for (int k = matrix.column_start[c] + 1; k < matrix.column_start[c + 1]; ++k) {
      const int at = next[matrix.row[k]]++;
      block_[at] = k;
      column_[at] = c;
    }
  }
}

void SymmetricProduct::multiply(const BlockMatrix& matrix, const VecX& x, VecX& y) {
  if (matrix.version != version_ || matrix.columns() != columns_) index_rows(matrix);
  y.resize(x.size());
  const double* values = matrix.values.data();
  for_each(columns_, [&](int r) {
    TransposedSum own;
    for (int k = matrix.column_start[r]; k < matrix.column_start[r + 1]; ++k)
      own.add(BlockLanes(values + 9 * std::ptrdiff_t(k)), load3(x.data() + 3 * std::ptrdiff_t(matrix.row[k])));
    Lanes sum = own.sum();
    for (int i = row_start_[r]; i < row_start_[r + 1]; ++i)
      sum += BlockLanes(values + 9 * std::ptrdiff_t(block_[i])).times(x.data() + 3 * std::ptrdiff_t(column_[i]));
    store3(sum, y.data() + 3 * std::ptrdiff_t(r));
  }, 128);
}

}  // namespace tack
