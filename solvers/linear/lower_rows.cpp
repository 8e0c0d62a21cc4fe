#include "solvers/linear/lower_rows.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int shortest_run = 512, most_runs = 64;  // columns, runs
constexpr int rows_per_task = 1024;

// A run of columns, and the entries of its blocks in each row that has some.
struct Run {
  int first_row() const { return first_column; }  // the diagonal block is the first of a column
  int row_end() const { return first_column + static_cast<int>(next.size()); }

  int first_column = 0, column_end = 0;
  std::vector<int> next;  // for each row: number of blocks, then the next entry
};

// Calls body(next entry of the row, block, column) for all blocks, in the order of columns.
template <class Body>
void for_each_block(const BlockMatrix& matrix, Run& run, const Body& body) {
  for (int c = run.first_column; c < run.column_end; ++c)
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) body(run.next[matrix.row[k] - run.first_row()], k, c);
}

// Calls body(next entries of a run, row, end) for the rows of [first, last) that each run has, in the order of runs.
template <class Body>
void for_each_part(std::vector<Run>& runs, int first, int last, const Body& body) {
  for (Run& run : runs) {
    const int row = std::max(first, run.first_row()), end = std::min(last, run.row_end());
    if (row < end) body(run.next.data() - run.first_row(), row, end);
  }
}

}  // namespace

// Counts in runs of columns, which write without locks.
void LowerRows::build(const BlockMatrix& matrix) {
  const int n = matrix.columns(), count = std::clamp(n / shortest_run, 1, most_runs), length = (n + count - 1) / count;
  std::vector<Run> runs(count);
  for_each(count, [&](int i) {
    Run& run = runs[i];
    run.first_column = std::min(i * length, n), run.column_end = std::min(run.first_column + length, n);
    int last_row = run.column_end - 1;
    for (int c = run.first_column; c < run.column_end; ++c) last_row = std::max(last_row, matrix.row[matrix.column_start[c + 1] - 1]);
    run.next.assign(last_row + 1 - run.first_row(), 0);
    for_each_block(matrix, run, [](int& number, int, int) { ++number; });
  }, 1);

  row_start.assign(n + 1, 0);
  for_each_chunk(n, [&](int, int first, int last) {
    for_each_part(runs, first, last, [&](const int* number, int row, int end) {
      for (int r = row; r < end; ++r) row_start[r + 1] += number[r];
    });
  }, rows_per_task);
  std::partial_sum(row_start.begin(), row_start.end(), row_start.begin());
  for_each_chunk(n, [&](int, int first, int last) {
    std::vector<int> at(row_start.begin() + first, row_start.begin() + last);
    for_each_part(runs, first, last, [&](int* next, int row, int end) {
      for (int r = row; r < end; ++r) at[r - first] += std::exchange(next[r], at[r - first]);
    });
  }, rows_per_task);

  for (auto* numbers : {&column, &block, &entry}) numbers->resize(matrix.row.size());
  for_each(count, [&](int i) {
    for_each_block(matrix, runs[i], [&](int& at, int k, int c) {
      column[at] = c;
      block[at] = k;
      entry[k] = at++;
    });
  }, 1);
}

}  // namespace tack
