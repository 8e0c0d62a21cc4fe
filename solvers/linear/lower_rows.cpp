#include "solvers/linear/lower_rows.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/parallel.hpp"

namespace tack {

// Counts in runs of columns, which write without locks, in the order of columns.
void LowerRows::build(const BlockMatrix& matrix) {
  constexpr int shortest_run = 4096, most_runs = 16;  // columns, runs
  const int n = matrix.columns(), runs = std::clamp(n / shortest_run, 1, most_runs), run = (n + runs - 1) / runs;
  std::vector<int> next(runs * static_cast<size_t>(n));  // of each run and row
  const auto for_each_block = [&](const auto& body) {
    for_each(runs, [&](int i) {
      int* const of_run = next.data() + static_cast<size_t>(i) * n;
      for (int c = i * run; c < std::min(i * run + run, n); ++c)
        for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) body(of_run[matrix.row[k]], k, c);
    }, 1);
  };
  for_each_block([](int& count, int, int) { ++count; });
  row_start.resize(n + 1);
  row_start[0] = 0;
  for_each(n, [&](int r) {
    int sum = 0;
    for (int i = 0; i < runs; ++i) sum += next[static_cast<size_t>(i) * n + r];
    row_start[r + 1] = sum;
  }, 1024);
  std::partial_sum(row_start.begin(), row_start.end(), row_start.begin());
  for_each(n, [&](int r) {
    int at = row_start[r];
    for (int i = 0; i < runs; ++i) at += std::exchange(next[static_cast<size_t>(i) * n + r], at);
  }, 1024);
  for (auto* numbers : {&column, &block, &entry}) numbers->resize(matrix.row.size());
  for_each_block([&](int& at, int k, int c) {
    column[at] = c;
    block[at] = k;
    entry[k] = at++;
  });
}

}  // namespace tack
