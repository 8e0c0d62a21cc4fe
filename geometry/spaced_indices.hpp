// Evenly spread choice of a few of many samples.
#pragma once

#include <algorithm>
#include <vector>

namespace tack {

// Returns `wanted` indices below `count`, evenly spread with both ends; for one, the last. All
// indices if fewer are there.
inline std::vector<int> spaced_indices(int count, int wanted) {
  std::vector<int> numbers;
  const int kept = std::min(count, std::max(1, wanted));
  for (int i = 0; i < kept; ++i)
    numbers.push_back(
        kept == 1
            ? count - 1
            : static_cast<int>((static_cast<long>(i) * (count - 1) + (kept - 1) / 2) / (kept - 1)));
  return numbers;
}

}  // namespace tack
