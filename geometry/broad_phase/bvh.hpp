// Bounding volume hierarchy over n boxes, with eight children per node.
//
// Key idea: eight consecutive boxes of a space-filling order form a group, eight consecutive groups
// form a group of the next level, and so on. The tree is implicit in the order, without pointers,
// and does not depend on the number of threads. New boxes are refitted into the old order while the
// nodes stay compact.
//
// Primitives are active or inactive (obstacles). A search never reports a pair of inactive
// primitives, and skips subtrees without active ones. Primitives of one rigid group are consecutive
// in the order, so that most nodes contain one group alone. A search for partners outside the rigid
// group of a primitive skips such nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/broad_phase/aabb.hpp"
#include "geometry/broad_phase/box8.hpp"

namespace tack {

class Bvh {
 public:
  Bvh() = default;
  // active: a flag per primitive; empty: all are active. rigid_group: per primitive, -1: none;
  // empty: no primitive is in one. Throws InputError if sizes disagree.
  explicit Bvh(const std::vector<Aabb>& boxes, const std::vector<char>& active = {},
               const std::vector<int>& rigid_group = {});

  // Sets new boxes of the primitives. Keeps the order (refit) unless the summed surface area of the
  // nodes exceeds `growth` times that at the last ordering. Returns true if re-ordered.
  bool update(const std::vector<Aabb>& boxes, double growth = 1.5);

  // Sets which primitives are active from the next update on: a flag per primitive. Throws
  // InputError if sizes disagree.
  void set_active(std::vector<char> active);

  int size() const { return static_cast<int>(primitive_active_.size()); }
  int levels() const { return static_cast<int>(level_begin_.size()) - 1; }
  // Number of groups at a level. Level 0 contains the primitives; the last level is one group, the
  // root.
  int groups(int level) const { return level_begin_[level + 1] - level_begin_[level]; }
  const Box8& boxes(int level, int group) const { return boxes_[level_begin_[level] + group]; }
  // The box around a group.
  const Aabb& bound(int level, int group) const { return bounds_[level_begin_[level] + group]; }
  // Bit i: lane i contains an active primitive, or a subtree with one.
  unsigned active(int level, int group) const { return active_[level_begin_[level] + group]; }
  // Returns the rigid group of all primitives below a group of nodes; -1 if they differ.
  int rigid_group(int level, int group) const {
    return rigid_group_.empty() ? -1 : rigid_group_[level_begin_[level] + group];
  }
  // The primitives in the lanes of a group of level 0; -1 in empty lanes.
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
  double built_area_ = 0.0;                         // half areas summed [m^2]
};

}  // namespace tack
