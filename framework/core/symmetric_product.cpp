#include "framework/core/symmetric_product.hpp"

#include "framework/assembly/parallel.hpp"

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
  for_each(columns_, [&](int r) {
    int k = matrix.column_start[r];
    Vec3 sum = matrix.block(k) * x.segment<3>(3 * r);
    for (++k; k < matrix.column_start[r + 1]; ++k)
      sum += matrix.block(k).transpose() * x.segment<3>(3 * matrix.row[k]);
    for (int i = row_start_[r]; i < row_start_[r + 1]; ++i)
      sum += matrix.block(block_[i]) * x.segment<3>(3 * column_[i]);
    y.segment<3>(3 * r) = sum;
  }, 128);
}

}  // namespace tack
