#include "solvers/linear/domain_rows.hpp"

#include <algorithm>
#include <numeric>

#include "framework/core/disjoint_sets.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int smallest_group = 64;  // separators

constexpr int largest_part = 6;     // at most one vertex in largest_part may be a separator

int last_row(const BlockMatrix& matrix, int column) { return matrix.row[matrix.column_start[column + 1] - 1]; }

// Returns, for each cut, the number of vertices before it that are coupled to vertices after it.
std::vector<int> crossings(const BlockMatrix& matrix) {
  std::vector<int> count(matrix.columns() + 2, 0);
  for (int c = 0; c < matrix.columns(); ++c) {
    ++count[c + 1];
    --count[last_row(matrix, c) + 1];
  }
  std::partial_sum(count.begin(), count.end(), count.begin());
  return count;
}

// Returns the ends of domains of `size` to 2 `size` vertices, each at the least crossed cut in its
// range.
std::vector<int> cut(const std::vector<int>& crossing, int n, int size) {
  std::vector<int> ends;
  for (int first = 0; first < n; first = ends.back()) {
    if (n - first < 2 * size) {
      ends.push_back(n);
    } else {
      const auto begin = crossing.begin() + first + size, end = crossing.begin() + std::min(first + 2 * size, n - size);
      ends.push_back(static_cast<int>(std::min_element(begin, end + 1) - crossing.begin()));
    }
  }
  return ends;
}

int count_separators(const BlockMatrix& matrix, const std::vector<int>& cuts) {
  int count = 0, first = 0;
  for (const int last : cuts)
    for (; first < last; ++first) count += last_row(matrix, first) >= last;
  return count;
}

}  // namespace

void DomainRows::build(const BlockMatrix& matrix, int domain_size) {
  const int n = matrix.columns();
  const std::vector<int> crossing = crossings(matrix);
  std::vector<int> cuts = cut(crossing, n, domain_size);
  while (largest_part * count_separators(matrix, cuts) > n) {
    domain_size += (domain_size + 1) / 2;
    cuts = cut(crossing, n, domain_size);
  }
  separate(matrix, cuts);
  std::vector<int> row_of(n);
  for (int k = 0; k < n; ++k) row_of[vertex[k]] = k;

  row_start.assign(n + 1, 0);
  const auto for_each_block = [&](const auto& body) {
    for (int c = 0; c < n; ++c)
      for (int b = matrix.column_start[c]; b < matrix.column_start[c + 1]; ++b)
        body(b, row_of[matrix.row[b]], row_of[c]);
  };
  for_each_block([&](int, int r, int c) { ++row_start[std::max(r, c) + 1]; });
  std::partial_sum(row_start.begin(), row_start.end(), row_start.begin());
  struct Entry {
    int column;
    Source source;
  };
  std::vector<Entry> entries(matrix.row.size());
  auto next = row_start;
  for_each_block([&](int b, int r, int c) { entries[next[std::max(r, c)]++] = {std::min(r, c), {b, r < c}}; });
  column.resize(entries.size());
  source.resize(entries.size());
  for_each(n, [&](int k) {
    std::sort(entries.begin() + row_start[k], entries.begin() + row_start[k + 1],
              [](const Entry& a, const Entry& b) { return a.column < b.column; });
    for (int e = row_start[k]; e < row_start[k + 1]; ++e) {
      column[e] = entries[e].column;
      source[e] = entries[e].source;
    }
  });
  sort_columns();
}

void DomainRows::separate(const BlockMatrix& matrix, const std::vector<int>& cuts) {
  vertex.clear();
  domain_start.assign(1, 0);
  std::vector<int> separating;
  int c = 0;
  for (const int last : cuts) {
    for (; c < last; ++c) (last_row(matrix, c) >= last ? separating : vertex).push_back(c);
    domain_start.push_back(static_cast<int>(vertex.size()));
  }
  group(matrix, separating);
}

void DomainRows::group(const BlockMatrix& matrix, const std::vector<int>& separating) {
  std::vector<char> separates(matrix.columns(), 0);
  for (const int c : separating) separates[c] = 1;
  DisjointSets sets(matrix.columns());
  for (const int c : separating)
    for (int b = matrix.column_start[c]; b < matrix.column_start[c + 1]; ++b)
      if (separates[matrix.row[b]]) sets.join(c, matrix.row[b]);
  std::vector<int> size(matrix.columns(), 0);
  for (const int c : separating) ++size[sets.find(c)];
  std::vector<int> group_of(matrix.columns(), 0);
  group_start.assign(1, static_cast<int>(vertex.size()));
  for (const int c : separating) {
    if (sets.find(c) != c) continue;
    if (groups() == 0 || group_start.back() - group_start[groups() - 1] >= smallest_group)
      group_start.push_back(group_start.back());
    group_of[c] = groups() - 1;
    group_start.back() += size[c];
  }
  auto next = group_start;
  vertex.resize(vertex.size() + separating.size());
  for (const int c : separating) vertex[next[group_of[sets.find(c)]]++] = c;
}

void DomainRows::sort_columns() {
  below_start.assign(size() + 1, 0);
  for (int k = 0; k < size(); ++k)
    for (int e = row_start[k]; e < diagonal(k); ++e) ++below_start[column[e] + 1];
  std::partial_sum(below_start.begin(), below_start.end(), below_start.begin());
  below_row.resize(below_start.back());
  below_entry.resize(below_start.back());
  auto next = below_start;
  for (int k = 0; k < size(); ++k)
    for (int e = row_start[k]; e < diagonal(k); ++e) {
      const int at = next[column[e]]++;
      below_row[at] = k;
      below_entry[at] = e;
    }
}

}  // namespace tack
