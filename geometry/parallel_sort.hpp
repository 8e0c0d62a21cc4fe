// Merge sort in parallel loops: runs are sorted by themselves, then merged pairwise. Each merge is
// cut into pieces of equal length of its output (merge path, Odeh et al. 2012). Equal items may
// change their order, but the same input gives the same order for any number of threads.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "geometry/parallel.hpp"

namespace tack {

namespace detail {

/// Returns how many of the first `taken` items of the merged ranges come from `a`.
template <class T>
int merge_split(const T* a, int size_a, const T* b, int size_b, int taken) {
  int low = std::max(0, taken - size_b), high = std::min(taken, size_a);
  while (low < high) {
    const int middle = low + (high - low) / 2;
    if (b[taken - middle - 1] < a[middle]) high = middle;
    else low = middle + 1;
  }
  return low;
}

}  // namespace detail

/// Sorts items ascending by operator<.
template <class T>
void parallel_sort(std::vector<T>& items, SourcePosition loop = SourcePosition::current()) {
  constexpr int run = 4096;
  const int n = static_cast<int>(items.size());
  for_each_chunk(
      n, [&](int, int first, int last) { std::sort(items.begin() + first, items.begin() + last); },
      run, loop);
  if (n <= run) return;
  std::vector<T> merged(items.size());
  for (long width = run; width < n; width *= 2) {
    for_each_chunk(
        n,
        [&](int, int first, int last) {
          const int begin = static_cast<int>(first - first % (2 * width));
          const int middle = static_cast<int>(std::min<long>(begin + width, n));
          const int end = static_cast<int>(std::min<long>(begin + 2 * width, n));
          const T *a = items.data() + begin, *b = items.data() + middle;
          const int size_a = middle - begin, size_b = end - middle;
          const int a0 = detail::merge_split(a, size_a, b, size_b, first - begin);
          const int a1 = detail::merge_split(a, size_a, b, size_b, last - begin);
          std::merge(a + a0, a + a1, b + (first - begin - a0), b + (last - begin - a1),
                     merged.begin() + first);
        },
        run, loop);
    std::swap(items, merged);
  }
}

}  // namespace tack
