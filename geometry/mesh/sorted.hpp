// Elements and lists in ascending order, for comparison.
#pragma once

#include <algorithm>
#include <vector>

namespace tack {

// Returns the element with its vertices in ascending order.
template <class Element>
Element sorted(Element element) {
  std::sort(element.begin(), element.end());
  return element;
}

template <class T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace tack
