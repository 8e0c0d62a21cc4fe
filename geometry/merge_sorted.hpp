// Merge of sorted lists, in parallel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "geometry/parallel.hpp"

namespace tack {

/// Returns the merge of two lists that are sorted by key(entry). No key is in both.
template <class T, class Key>
std::vector<T> merge_sorted(const std::vector<T>& a, const std::vector<T>& b, const Key& key) {
  constexpr int chunk = 1024;
  const auto less = [&](const T& p, const T& q) { return key(p) < key(q); };
  std::vector<T> all(a.size() + b.size());
  if (a.empty()) {
    std::copy(b.begin(), b.end(), all.begin());
    return all;
  }
  const int n = static_cast<int>(a.size());
  // A chunk of `a` is merged with the entries of `b` that follow its first one.
  const auto first_after = [&](int i) {
    if (i == 0) return b.begin();
    return i == n ? b.end() : std::lower_bound(b.begin(), b.end(), a[i], less);
  };
  for_each_chunk(
      n,
      [&](int, int first, int last) {
        const auto begin = first_after(first);
        std::merge(a.begin() + first, a.begin() + last, begin, first_after(last),
                   all.begin() + first + (begin - b.begin()), less);
      },
      chunk);
  return all;
}

}  // namespace tack
