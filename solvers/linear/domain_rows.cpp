#include "solvers/linear/domain_rows.hpp"

#include <algorithm>

#include "framework/assembly/parallel.hpp"

namespace tack {

void DomainRows::build(const BlockMatrix& matrix, int domain_size) {
  const int n = matrix.columns();
  vertex.clear();
  domain_start.assign(1, 0);
  std::vector<int> separating;
  for (int first = 0; first < n; first += domain_size) {
    const int last = std::min(n, first + domain_size);
    for (int c = first; c < last; ++c)
      (matrix.row[matrix.column_start[c + 1] - 1] < last ? vertex : separating).push_back(c);
    domain_start.push_back(static_cast<int>(vertex.size()));
  }
  vertex.insert(vertex.end(), separating.begin(), separating.end());
  std::vector<int> row_of(n);
  for (int k = 0; k < n; ++k) row_of[vertex[k]] = k;

  row_start.assign(n + 1, 0);
  const auto for_each_block = [&](const auto& body) {
    for (int c = 0; c < n; ++c)
      for (int b = matrix.column_start[c]; b < matrix.column_start[c + 1]; ++b)
        body(b, row_of[matrix.row[b]], row_of[c]);
  };
  for_each_block([&](int, int r, int c) { ++row_start[std::max(r, c) + 1]; });
  for (int k = 0; k < n; ++k) row_start[k + 1] += row_start[k];
  entries.resize(matrix.row.size());
  auto next = row_start;
  for_each_block([&](int b, int r, int c) { entries[next[std::max(r, c)]++] = {std::min(r, c), b, r < c}; });
  for_each(n, [&](int k) {
    std::sort(entries.begin() + row_start[k], entries.begin() + row_start[k + 1],
              [](const Entry& a, const Entry& b) { return a.column < b.column; });
  });
}

}  // namespace tack
