// Disjoint sets (disjoint_sets.hpp) that several threads join at the same time without locks
// (Anderson and Woll 1991, Wait-free parallel algorithms for the union-find problem). A set is
// known by its smallest member, so that the order of the joins changes nothing.
#pragma once

#include <algorithm>
#include <atomic>
#include <vector>

namespace tack {

/// Disjoint sets of the numbers 0 .. n - 1 for several threads.
class ConcurrentDisjointSets {
 public:
  /// Makes n sets of one member each.
  void reset(int n) {
    root_.resize(n);
    for (int i = 0; i < n; ++i) root_[i] = i;
  }

  /// Returns the smallest member of the set of i, as it is now.
  int find(int i) {
    for (int above = load(i); above != i;) {
      // A member below its root never becomes a root again, so that it may skip one on the path.
      const int next = load(above);
      if (next != above) at(i).store(next, std::memory_order_relaxed);
      i = above, above = next;
    }
    return i;
  }

  void join(int i, int j) {
    while (true) {
      i = find(i), j = find(j);
      if (i == j) return;
      const int larger = std::max(i, j);
      int expected = larger;  // or another thread has joined it to a set meanwhile
      const int smaller = std::min(i, j);
      if (at(larger).compare_exchange_strong(expected, smaller, std::memory_order_relaxed)) return;
    }
  }

 private:
  std::atomic_ref<int> at(int i) { return std::atomic_ref<int>(root_[i]); }
  int load(int i) { return at(i).load(std::memory_order_relaxed); }

  std::vector<int> root_;
};

}  // namespace tack
