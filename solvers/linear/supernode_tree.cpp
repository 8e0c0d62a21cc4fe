#include "solvers/linear/supernode_tree.hpp"

#include <algorithm>
#include <queue>
#include <utility>

#include "geometry/parallel.hpp"
#include "geometry/prefix_sums.hpp"

namespace tack {
namespace {

constexpr int nodes_per_chunk = 64;
// Chunks of the matrix's columns that count entries: each has a count for every column of the factor.
constexpr int counting_chunks = 24, counting_columns_min = 256;

}  // namespace

SupernodeTree::SupernodeTree(const cholmod_factor& factor, const BlockMatrix& matrix)
    : size(matrix.size()) {
  read(factor);
  connect();
  locate_blocks(matrix);
  cut();
  local = rows;
  for_each(static_cast<int>(subtrees.size()), [&](int i) { number_locally(subtrees[i]); }, 1);
  factor_tasks = tasks_of_factorisation(*this);
  solve_tasks = tasks_of_solve(*this);
}

// Reads the factor of blocks; each of its rows and columns stands for three scalars.
void SupernodeTree::read(const cholmod_factor& factor) {
  const auto threefold = [](const void* data, size_t n) {
    const int* p = static_cast<const int*>(data);
    std::vector<int> expanded(3 * n);
    for (size_t k = 0; k < n; ++k)
      for (int d = 0; d < 3; ++d) expanded[3 * k + d] = 3 * p[k] + d;
    return expanded;
  };
  const auto starts = [](const void* data, size_t n) {
    const int* p = static_cast<const int*>(data);
    std::vector<int> tripled(p, p + n);
    for (int& k : tripled) k *= 3;
    return tripled;
  };
  permutation = threefold(factor.Perm, factor.n);
  first = starts(factor.super, factor.nsuper + 1);
  row_start = starts(factor.pi, factor.nsuper + 1);
  rows = threefold(factor.s, static_cast<size_t>(row_start.back() / 3));
  panel.assign(1, 0);
  for (size_t s = 0; s < factor.nsuper; ++s)
    panel.push_back(panel.back() + std::ptrdiff_t(first[s + 1] - first[s]) *
                                       (row_start[s + 1] - row_start[s]));
}

void SupernodeTree::connect() {
  const int count = static_cast<int>(first.size()) - 1;
  std::vector<int> node_of(size);
  for (int s = 0; s < count; ++s) std::fill(&node_of[first[s]], &node_of[first[s]] + columns(s), s);
  parent.resize(count);
  position.assign(rows.size(), -1);
  child_start.assign(count + 1, 0);
  for_each(count, [&](int s) {
    parent[s] = below(s) == 0 ? -1 : node_of[*rows_below(s)];
    if (parent[s] < 0) return;
    int at = row_start[parent[s]];
    for (int k = row_start[s] + columns(s); k < row_start[s + 1]; ++k) {
      while (rows[at] != rows[k]) ++at;
      position[k] = at - row_start[parent[s]];
    }
  }, nodes_per_chunk);
  for (int s = 0; s < count; ++s)
    if (parent[s] >= 0) ++child_start[parent[s] + 1];
  for (int s = 0; s < count; ++s) child_start[s + 1] += child_start[s];
  children.resize(child_start.back());
  auto next = child_start;
  for (int s = 0; s < count; ++s)
    if (parent[s] >= 0) children[next[parent[s]]++] = s;
}

// A counting sort. Chunks of the matrix's columns count their entries, so that the order of the
// entries of a column of the factor is that of the matrix.
void SupernodeTree::locate_blocks(const BlockMatrix& matrix) {
  const int n = matrix.columns(), chunk = std::max(counting_columns_min, chunk_count(n, counting_chunks));
  std::vector<int> inverse(n), node_of(n);
  for_each(n, [&](int k) { inverse[permutation[3 * k] / 3] = k; }, 4096);
  for_each(nodes(), [&](int s) { std::fill_n(&node_of[first[s] / 3], columns(s) / 3, s); }, nodes_per_chunk);
  const auto for_each_block = [&](int begin, int end, const auto& body) {
    for (int c = begin; c < end; ++c)
      for (int b = matrix.column_start[c]; b < matrix.column_start[c + 1]; ++b) {
        const int row = inverse[matrix.row[b]], column = inverse[c];
        body(b, row < column, std::max(row, column), std::min(row, column));
      }
  };
  std::vector<std::vector<int>> next(chunk_count(n, chunk));  // counts, then the next entry of each column
  for_each_chunk(n, [&](int k, int begin, int end) {
    next[k].assign(n, 0);
    for_each_block(begin, end, [&](int, bool, int, int column) { ++next[k][column]; });
  }, chunk);
  entry_start.assign(n + 1, 0);
  for_each(n, [&](int c) {
    for (std::vector<int>& counts : next) entry_start[c + 1] += counts[c];
  }, 1024);
  prefix_sums(entry_start);
  for_each(n, [&](int c) {
    int at = entry_start[c];
    for (std::vector<int>& counts : next) at += std::exchange(counts[c], at);
  }, 1024);
  entries.resize(matrix.blocks());
  for_each_chunk(n, [&](int k, int begin, int end) {
    for_each_block(begin, end, [&](int b, bool transposed, int row, int column) {
      const int s = node_of[column];
      const auto rows_begin = rows.begin() + row_start[s];
      const auto found = std::lower_bound(rows_begin, rows.begin() + row_start[s + 1], 3 * row) - rows_begin;
      entries[next[k][column]++] = {b, transposed, panel[s] + found + std::ptrdiff_t(3 * column - first[s]) * height(s)};
    });
  }, chunk);
}

// Splits the heaviest subtree until none has more than a small fraction of the work, or more work
// than is worth a task of its own.
void SupernodeTree::cut() {
  constexpr double largest_part = 1.0 / 96, smallest_part = 3e5;
  constexpr double entry_work = 30;  // of an entry that is set to zero and added to, in products
  std::vector<double> work(nodes());
  std::vector<int> leftmost(nodes());
  double total = 0;
  for (int s = 0; s < nodes(); ++s) {
    leftmost[s] = s;
    const double h = height(s);
    const double own = h * h * (columns(s) + entry_work / 2) + 200;
    total += own;
    work[s] += own;
    for (int k = child_start[s]; k < child_start[s + 1]; ++k) {
      work[s] += work[children[k]];
      leftmost[s] = std::min(leftmost[s], leftmost[children[k]]);
    }
  }
  std::priority_queue<std::pair<double, int>> queue;
  for (int s = 0; s < nodes(); ++s)
    if (parent[s] < 0) queue.emplace(work[s], s);
  while (!queue.empty()) {
    const auto [heavy, s] = queue.top();
    queue.pop();
    if (heavy <= std::max(largest_part * total, smallest_part) || child_start[s] == child_start[s + 1]) {
      subtrees.push_back({leftmost[s], s, heavy});
      continue;
    }
    top.push_back(s);
    for (int k = child_start[s]; k < child_start[s + 1]; ++k) queue.emplace(work[children[k]], children[k]);
  }
  std::sort(top.begin(), top.end());
}

void SupernodeTree::number_locally(const Subtree& subtree) {
  const int begin = first[subtree.first], end = first[subtree.root + 1];
  const int* outside = rows_below(subtree.root);
  for (int s = subtree.first; s <= subtree.root; ++s) {
    int at = 0;
    for (int k = row_start[s]; k < row_start[s + 1]; ++k) {
      if (rows[k] < end) {
        local[k] = rows[k] - begin;
      } else {
        while (outside[at] != rows[k]) ++at;
        local[k] = end - begin + at;
      }
    }
  }
}

}  // namespace tack
