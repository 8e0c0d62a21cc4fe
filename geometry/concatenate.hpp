// Concatenation of lists that were computed by chunks.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/parallel.hpp"

namespace tack {

template <class T>
void concatenate(const std::vector<std::vector<T>>& lists, std::vector<T>& all) {
  std::vector<std::size_t> begin(lists.size() + 1, 0);
  for (std::size_t i = 0; i < lists.size(); ++i) begin[i + 1] = begin[i] + lists[i].size();
  all.resize(begin.back());
  for_each(
      static_cast<int>(lists.size()),
      [&](int i) {
        std::copy(lists[i].begin(), lists[i].end(),
                  all.begin() + static_cast<std::ptrdiff_t>(begin[i]));
      },
      4);
}

}  // namespace tack
