// Lists that were made by chunks, one behind the other.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/parallel.hpp"

namespace tack {

template <class T>
void concatenate(const std::vector<std::vector<T>>& parts, std::vector<T>& all) {
  std::vector<std::size_t> begin(parts.size() + 1, 0);
  for (std::size_t i = 0; i < parts.size(); ++i) begin[i + 1] = begin[i] + parts[i].size();
  all.resize(begin.back());
  for_each(
      static_cast<int>(parts.size()),
      [&](int i) {
        std::copy(parts[i].begin(), parts[i].end(),
                  all.begin() + static_cast<std::ptrdiff_t>(begin[i]));
      },
      64);
}

}  // namespace tack
