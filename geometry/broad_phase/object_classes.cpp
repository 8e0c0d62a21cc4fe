#include "geometry/broad_phase/object_classes.hpp"

#include <algorithm>

namespace tack {

std::vector<std::pair<int, int>> ObjectClasses::examples() const {
  std::vector<int> first(count(), -1), second(count(), -1);
  for (int i = 0; i < objects(); ++i) {
    const int c = of_[i];
    if (first[c] < 0) first[c] = i;
    else if (second[c] < 0) second[c] = i;
  }
  std::vector<std::pair<int, int>> pairs;
  for (int a = 0; a < count(); ++a) {
    pairs.emplace_back(first[a], first[a]);
    if (second[a] >= 0) pairs.emplace_back(first[a], second[a]);
    for (int b = a + 1; b < count(); ++b) pairs.emplace_back(first[a], first[b]);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace tack
