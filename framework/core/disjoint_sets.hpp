// Disjoint sets of the numbers 0 .. n - 1 (union-find). The smallest member represents its set.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace tack {

/// Disjoint sets of the numbers 0 .. n - 1.
class DisjointSets {
 public:
  explicit DisjointSets(int n) : root_(n) { std::iota(root_.begin(), root_.end(), 0); }

  int find(int i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }
  void join(int i, int j) {
    const int one = find(i), other = find(j);
    root_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<int> root_;
};

}  // namespace tack
