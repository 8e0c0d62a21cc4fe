// Triangles of other objects that may come within range of single triangles: what one search of the
// broad phase found, by triangle.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace tack {

class NearbyLists {
 public:
  void clear() { *this = {}; }
  // Adds the list of a triangle. Triangles ascend.
  void add(int triangle, std::span<const int> near) {
    triangles_.push_back(triangle);
    near_.insert(near_.end(), near.begin(), near.end());
    end_.push_back(near_.size());
  }
  // Adds the lists of others, whose triangles are greater.
  void append(const NearbyLists& others) {
    for (std::size_t i = 0; i < others.triangles_.size(); ++i)
      add(others.triangles_[i], others.list(i));
  }
  // Returns whether a triangle has a list, and sets `near` to it.
  bool find(int triangle, std::span<const int>& near) const {
    const auto at = std::lower_bound(triangles_.begin(), triangles_.end(), triangle);
    if (at == triangles_.end() || *at != triangle) return false;
    near = list(static_cast<std::size_t>(at - triangles_.begin()));
    return true;
  }

 private:
  std::span<const int> list(std::size_t index) const {
    const std::size_t begin = index == 0 ? 0 : end_[index - 1];
    return {near_.data() + begin, near_.data() + end_[index]};
  }

  std::vector<int> triangles_;    // ascending
  std::vector<std::size_t> end_;  // of each list
  std::vector<int> near_;
};

}  // namespace tack
