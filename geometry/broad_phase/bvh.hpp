// A bounding volume hierarchy over n boxes, eight children to a node. Key idea: boxes are packed,
// eight consecutive ones of a space-filling order to a group, eight consecutive groups to a group
// of the next level, and so on; the tree is implicit in the order, there are no pointers, and it is
// the same for any number of threads. New boxes are refitted into the old order while that stays
// good.
//
// Each primitive may be active or inactive (obstacles); a search never reports two inactive ones
// and skips whole subtrees for that reason. Primitives of one rigid group lie next to each other in
// the order, so that most nodes hold one group alone, and a search for partners outside a
// primitive's own rigid group skips such nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/broad_phase/aabb.hpp"
#include "geometry/broad_phase/box8.hpp"

namespace tack {

class Bvh {
 public:
  Bvh() = default;
  // active: a flag per primitive; empty: all are active. rigid_group: a number per primitive (-1:
  // in none); empty: no primitive is in one. Throws InputError if sizes disagree.
  explicit Bvh(const std::vector<Aabb>& boxes, const std::vector<char>& active = {},
               const std::vector<int>& rigid_group = {});

  // New boxes for the same primitives. Keeps the order (refit) unless the summed surface area of
  // the nodes has grown by more than `growth` since the order was made. Returns true if re-ordered.
  bool update(const std::vector<Aabb>& boxes, double growth = 1.5);

  // Sets which primitives are active from the next update on: a flag per primitive. Throws
  // InputError if sizes disagree.
  void set_active(std::vector<char> active);

  int size() const { return static_cast<int>(primitive_active_.size()); }
  int levels() const { return static_cast<int>(level_begin_.size()) - 1; }
  // Number of groups at a level; level 0 holds the primitives, the last level is one group: the
  // root.
  int groups(int level) const { return level_begin_[level + 1] - level_begin_[level]; }
  const Box8& boxes(int level, int group) const { return boxes_[level_begin_[level] + group]; }
  // The box around a group.
  const Aabb& bound(int level, int group) const { return bounds_[level_begin_[level] + group]; }
  // Bit i: lane i holds, or leads to, an active primitive.
  unsigned active(int level, int group) const { return active_[level_begin_[level] + group]; }
  // Returns the rigid group of all primitives below a group of nodes; -1 if they differ.
  int rigid_group(int level, int group) const {
    return rigid_group_.empty() ? -1 : rigid_group_[level_begin_[level] + group];
  }
  // The primitives in the lanes of a group of level 0; -1 in lanes that hold none.
  const int* primitives(int group) const { return order_.data() + group * Box8::width; }

 private:
  void order_by_position(const std::vector<Aabb>& boxes);
  void lay_out_levels();
  void fill(const std::vector<Aabb>& boxes);
  void fill_rigid_groups();
  void fill_group(const std::vector<Aabb>& boxes, int level, int group);
  double node_area() const;

  std::vector<int> order_;  // padded with -1 to whole groups
  std::vector<char> primitive_active_;
  std::vector<int> level_begin_ = {
      0};  // first group of each level in the arrays below, and the end
  std::vector<Box8> boxes_;
  std::vector<Aabb> bounds_;
  std::vector<std::uint8_t> active_;
  std::vector<int> primitive_group_, rigid_group_;  // empty: no primitive is in a rigid group
  double built_area_ = 0.0;  // half areas summed [m^2]
};

}  // namespace tack
