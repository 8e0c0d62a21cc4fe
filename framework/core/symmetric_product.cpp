#include "framework/core/symmetric_product.hpp"

#include <algorithm>
#include <utility>

#include "framework/core/lanes.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int run_length = 1024;  // columns

}  // namespace

void SymmetricProduct::index(const BlockMatrix& matrix) {
  columns_ = matrix.columns();
  version_ = matrix.version;
  sum_of_.resize(matrix.row.size());
  sum_start_.assign(1, 0);
  std::vector<std::pair<int, int>> outside;  // row, sum
  std::vector<int> sum_index(columns_, -1);      // index of the sum of a row in the current run
  for (int first = 0; first < columns_; first += run_length) {
    const int last = std::min(first + run_length, columns_);
    const size_t before = outside.size();
    int count = last - first;
    for (int k = matrix.column_start[first]; k < matrix.column_start[last]; ++k) {
      const int row = matrix.row[k];
      if (row >= last && sum_index[row] < 0) {
        outside.emplace_back(row, sum_start_.back() + count);
        sum_index[row] = count++;
      }
      sum_of_[k] = row < last ? row - first : sum_index[row];
    }
    for (size_t i = before; i < outside.size(); ++i) sum_index[outside[i].first] = -1;
    sum_start_.push_back(sum_start_.back() + count);
  }
  sums_.resize(4 * static_cast<size_t>(sum_start_.back()));
  later_start_.assign(columns_ + 1, 0);
  for (const auto& [row, sum] : outside) ++later_start_[row + 1];
  for (int r = 0; r < columns_; ++r) later_start_[r + 1] += later_start_[r];
  later_.resize(outside.size());
  auto next = later_start_;
  for (const auto& [row, sum] : outside) later_[next[row]++] = sum;
}

void SymmetricProduct::multiply_run(const BlockMatrix& matrix, const VecX& x, int run, int first, int last) {
  double* const sums = sums_.data() + 4 * static_cast<size_t>(sum_start_[run]);
  std::fill(sums, sums_.data() + 4 * static_cast<size_t>(sum_start_[run + 1]), 0.0);
  const double* block = matrix.values.data() + 9 * static_cast<size_t>(matrix.column_start[first]);
  for (int c = first; c < last; ++c) {
    const double* const own_x = x.data() + 3 * static_cast<size_t>(c);
    int k = matrix.column_start[c];
    Lanes diagonal = BlockLanes(block).times(own_x);
    TransposedSum own;
    for (block += 9, ++k; k < matrix.column_start[c + 1]; ++k, block += 9) {
      const BlockLanes lanes(block);
      own.add(lanes, load3(x.data() + 3 * static_cast<size_t>(matrix.row[k])));
      double* const sum = sums + 4 * static_cast<size_t>(sum_of_[k]);
      store4(load4(sum) + lanes.times(own_x), sum);
    }
    double* const sum = sums + 4 * static_cast<size_t>(c - first);
    store4(load4(sum) + diagonal + own.sum(), sum);
  }
}

void SymmetricProduct::multiply(const BlockMatrix& matrix, const VecX& x, VecX& y) {
  if (matrix.version != version_ || matrix.columns() != columns_) index(matrix);
  y.resize(x.size());
  for_each_chunk(columns_, [&](int run, int first, int last) { multiply_run(matrix, x, run, first, last); }, run_length);
  for_each_chunk(columns_, [&](int run, int first, int last) {
    for (int r = first; r < last; ++r) {
      Lanes sum = load4(sums_.data() + 4 * static_cast<size_t>(sum_start_[run] + r - first));
      for (int i = later_start_[r]; i < later_start_[r + 1]; ++i)
        sum += load4(sums_.data() + 4 * static_cast<size_t>(later_[i]));
      store3(sum, y.data() + 3 * static_cast<size_t>(r));
    }
  }, run_length);
  add_product(matrix.modes, x, y);
}

}  // namespace tack
