#include "solvers/linear/supernode_tree.hpp"

#include <algorithm>
#include <queue>

namespace tack {

SupernodeTree::SupernodeTree(const cholmod_factor& factor, const BlockMatrix& matrix)
    : size(matrix.size()) {
  read(factor);
  connect();
  locate_blocks(matrix);
  cut();
  sort_top();
  local = rows;
  for (const Subtree& tree : subtrees) number_locally(tree);
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
  for (int s = 0; s < count; ++s) {
    parent[s] = below(s) == 0 ? -1 : node_of[*rows_below(s)];
    if (parent[s] < 0) continue;
    ++child_start[parent[s] + 1];
    int at = row_start[parent[s]];
    for (int k = row_start[s] + columns(s); k < row_start[s + 1]; ++k) {
      while (rows[at] != rows[k]) ++at;
      position[k] = at - row_start[parent[s]];
    }
  }
  for (int s = 0; s < count; ++s) child_start[s + 1] += child_start[s];
  children.resize(child_start.back());
  auto next = child_start;
  for (int s = 0; s < count; ++s)
    if (parent[s] >= 0) children[next[parent[s]]++] = s;
}

void SupernodeTree::locate_blocks(const BlockMatrix& matrix) {
  std::vector<int> inverse(size), node_of(size), node(matrix.blocks());
  for (int k = 0; k < size; ++k) inverse[permutation[k]] = k;
  for (int s = 0; s < nodes(); ++s) std::fill(&node_of[first[s]], &node_of[first[s]] + columns(s), s);
  entry_start.assign(nodes() + 1, 0);
  entries.resize(matrix.blocks());
  const auto for_each_block = [&](const auto& body) {
    for (int c = 0; c < matrix.columns(); ++c)
      for (int b = matrix.column_start[c]; b < matrix.column_start[c + 1]; ++b)
        body(b, inverse[3 * matrix.row[b]], inverse[3 * c]);
  };
  for_each_block([&](int, int r, int c) { ++entry_start[node_of[std::min(r, c)] + 1]; });
  for (int s = 0; s < nodes(); ++s) entry_start[s + 1] += entry_start[s];
  auto next = entry_start;
  for_each_block([&](int b, int r, int c) {
    const int column = std::min(r, c), row = std::max(r, c), s = node_of[column];
    const auto begin = rows.begin() + row_start[s];
    const auto found = std::lower_bound(begin, rows.begin() + row_start[s + 1], row) - begin;
    entries[next[s]++] = {b, r < c, panel[s] + found + std::ptrdiff_t(column - first[s]) * height(s)};
  });
}

// Splits the heaviest subtree until none has more than a small fraction of the work.
void SupernodeTree::cut() {
  constexpr double largest_part = 1.0 / 12;
  std::vector<double> work(nodes());
  std::vector<int> leftmost(nodes());
  double total = 0;
  for (int s = 0; s < nodes(); ++s) {
    leftmost[s] = s;
    const double h = height(s);
    const double own = h * h * columns(s) + 200;
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
    if (heavy <= largest_part * total || child_start[s] == child_start[s + 1]) {
      subtrees.push_back({leftmost[s], s});
      continue;
    }
    top.push_back(s);
    for (int k = child_start[s]; k < child_start[s + 1]; ++k) queue.emplace(work[children[k]], children[k]);
  }
}

void SupernodeTree::sort_top() {
  std::sort(top.begin(), top.end());
  std::vector<size_t> level(nodes(), 0);
  for (const int s : top) {
    if (level[s] == top_levels.size()) top_levels.emplace_back();
    top_levels[level[s]].push_back(s);
    if (parent[s] >= 0) level[parent[s]] = std::max(level[parent[s]], level[s] + 1);
  }
}

void SupernodeTree::number_locally(const Subtree& tree) {
  const int begin = first[tree.first], end = first[tree.root + 1];
  const int* outside = rows_below(tree.root);
  for (int s = tree.first; s <= tree.root; ++s) {
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
