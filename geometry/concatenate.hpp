// Concatenation of lists that were computed by chunks.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/parallel.hpp"

namespace tack {

namespace detail {

// Writes the lists, in their order, over what `all` has from entry `first` on.
template <class T>
void write_lists(const std::vector<std::vector<T>>& lists, std::size_t first, std::vector<T>& all) {
  std::vector<std::size_t> begin(lists.size() + 1, first);
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

}  // namespace detail

/// Replaces `all` by the lists, in their order. Its memory is used again.
template <class T>
void concatenate(const std::vector<std::vector<T>>& lists, std::vector<T>& all) {
  detail::write_lists(lists, 0, all);
}

/// Appends the lists to `all`, in their order.
template <class T>
void append(const std::vector<std::vector<T>>& lists, std::vector<T>& all) {
  detail::write_lists(lists, all.size(), all);
}

}  // namespace tack
