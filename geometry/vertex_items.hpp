// Items by vertex: which of a list of items (stencils, pairs, elements) touch a vertex. Stored as
// one list of items, sorted by vertex, and the begin of each vertex in it.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace tack {

class VertexItems {
 public:
  VertexItems() = default;
  /// for_each(act): calls act(item, vertex) for each vertex of each item, items ascending; called
  /// twice.
  template <class ForEach>
  VertexItems(int vertices, const ForEach& for_each) : begin_(vertices + 1, 0) {
    for_each([&](int, int v) { ++begin_[v + 1]; });
    for (int v = 0; v < vertices; ++v) begin_[v + 1] += begin_[v];
    items_.resize(begin_.back());
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for_each([&](int item, int v) { items_[next[v]++] = item; });
  }

  bool empty() const { return items_.empty(); }
  std::span<const int> of(int v) const {
    return {items_.data() + begin_[v], items_.data() + begin_[v + 1]};
  }
  /// Returns the items that touch any of these vertices, ascending.
  std::vector<int> touching(std::span<const int> vertices) const {
    std::vector<int> all;
    if (empty()) return all;
    for (const int v : vertices) all.insert(all.end(), of(v).begin(), of(v).end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  std::vector<int> begin_, items_;
};

}  // namespace tack
