#include "framework/core/symmetric_product.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

#include "framework/core/lanes.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Returns the columns of a run: small matrices have 32 runs for the threads, if these are long
// enough that most sums are of their own rows.
int run_length(int columns) { return std::clamp(columns / 32, 256, 1024); }

}  // namespace

void SymmetricProduct::index(const BlockMatrix& matrix) {
  columns_ = matrix.columns();
  version_ = matrix.version;
  const int length = run_length(columns_), runs = chunk_count(columns_, length);
  sum_of_.resize(matrix.row.size());
  std::vector<std::vector<int>> later_rows(runs);  // of each run, in the order of their sums
  // Index of the sum of a row in the current run; -1 between runs.
  tbb::enumerable_thread_specific<std::vector<int>> sum_index(columns_, -1);
  for_each_chunk(columns_, [&](int run, int first, int last) {
    std::vector<int>& index_of = sum_index.local();
    for (int k = matrix.column_start[first]; k < matrix.column_start[last]; ++k) {
      const int row = matrix.row[k];
      if (row >= last && index_of[row] < 0) {
        index_of[row] = last - first + static_cast<int>(later_rows[run].size());
        later_rows[run].push_back(row);
      }
      sum_of_[k] = row < last ? row - first : index_of[row];
    }
    for (const int row : later_rows[run]) index_of[row] = -1;
  }, length);
  sum_start_.assign(1, 0);
  later_start_.assign(columns_ + 1, 0);
  for (int run = 0; run < runs; ++run) {
    const int own = std::min(length, columns_ - run * length);
    sum_start_.push_back(sum_start_.back() + own + static_cast<int>(later_rows[run].size()));
    for (const int row : later_rows[run]) ++later_start_[row + 1];
  }
  sums_.resize(4 * static_cast<size_t>(sum_start_.back()));
  for (int r = 0; r < columns_; ++r) later_start_[r + 1] += later_start_[r];
  later_.resize(later_start_.back());
  auto next = later_start_;
  for (int run = 0; run < runs; ++run) {
    int sum = sum_start_[run + 1] - static_cast<int>(later_rows[run].size());
    for (const int row : later_rows[run]) later_[next[row]++] = sum++;
  }
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
  const int length = run_length(columns_);
  for_each_chunk(columns_, [&](int run, int first, int last) { multiply_run(matrix, x, run, first, last); }, length);
  for_each_chunk(columns_, [&](int run, int first, int last) {
    for (int r = first; r < last; ++r) {
      Lanes sum = load4(sums_.data() + 4 * static_cast<size_t>(sum_start_[run] + r - first));
      for (int i = later_start_[r]; i < later_start_[r + 1]; ++i)
        sum += load4(sums_.data() + 4 * static_cast<size_t>(later_[i]));
      store3(sum, y.data() + 3 * static_cast<size_t>(r));
    }
  }, length);
  add_product(matrix.modes, x, y);
}

}  // namespace tack
