// Prefix sums of integers, in parallel.
#pragma once

#include <vector>

#include "geometry/parallel.hpp"

namespace tack {

/// Replaces each entry by the sum of the entries up to and including itself. With a leading zero,
/// counts become the offsets of consecutive lists.
template <class Integer>
void prefix_sums(std::vector<Integer>& values) {
  constexpr int chunk = 4096;
  const int n = static_cast<int>(values.size());
  std::vector<Integer> before(chunk_count(n, chunk) + 1, 0);  // the sum before each chunk
  const auto add_up = [&](int c, int first, int last) {
    Integer sum = before[c];
    for (int i = first; i < last; ++i) values[i] = sum += values[i];
  };
  if (n <= chunk) return add_up(0, 0, n);
  for_each_chunk(
      n,
      [&](int c, int first, int last) {
        for (int i = first; i < last; ++i) before[c + 1] += values[i];
      },
      chunk);
  for (std::size_t c = 1; c < before.size(); ++c) before[c] += before[c - 1];
  for_each_chunk(n, add_up, chunk);
}

}  // namespace tack
