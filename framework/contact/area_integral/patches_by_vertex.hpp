// Visible patches of groups of candidates (point_groups.hpp), found by vertex and object.
#pragma once

#include <array>
#include <numeric>
#include <span>
#include <vector>

#include "framework/contact/surface/visible_patches.hpp"

namespace tack {

// Visible patches of a group, constant through the step.
struct GroupPatches {
  int point, object;
  VisiblePatches visible;

  std::array<int, 2> key() const { return {point, object}; }
};

class PatchesByVertex {
 public:
  // groups: by point, then object; must outlive this. vertices: the number of global vertices.
  PatchesByVertex(const std::vector<GroupPatches>& groups, std::size_t vertices)
      : groups_(groups), first_(vertices + 1, 0) {
    for (const GroupPatches& g : groups) ++first_[g.point + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
  }

  const GroupPatches& operator[](int index) const { return groups_[index]; }
  // Returns the groups of a vertex.
  std::span<const GroupPatches> of_vertex(int vertex_index) const {
    return {groups_.data() + first_[vertex_index], groups_.data() + first_[vertex_index + 1]};
  }
  // Returns the index of the group of a vertex and an object; -1: none.
  int find(int vertex_index, int object) const {
    for (int i = first_[vertex_index]; i < first_[vertex_index + 1]; ++i)
      if (groups_[i].object == object) return i;
    return -1;
  }

 private:
  const std::vector<GroupPatches>& groups_;
  std::vector<int> first_;  // group of each vertex, and the end
};

}  // namespace tack
