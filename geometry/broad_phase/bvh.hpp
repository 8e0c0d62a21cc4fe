// A bounding volume hierarchy over n boxes, eight children to a node. Key idea: boxes are packed,
// eight consecutive ones of a space-filling order to a group, eight consecutive groups to a group
// of the next level, and so on; the tree is implicit in the order, there are no pointers, and it is
// the same for any number of threads. New boxes are refitted into the old order while that stays
// good.
//
// Each primitive may be active or inactive (obstacles); a search never reports two inactive ones
// and skips whole subtrees for that reason. Primitives may be kin, that is, of one rigid group: these lie next to each
// other in the order, so that most nodes hold no others, and searches for partners that are not kin skip them whole.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/broad_phase/aabb.hpp"
#include "geometry/broad_phase/box8.hpp"

namespace tack {

class Bvh {
 public:
  Bvh() = default;
  // `active` (one flag a primitive) may be empty: all active. `kin` (one number a primitive; -1: kin to none) may be
  // empty: none are. Throws InputError if sizes disagree.
  explicit Bvh(const std::vector<Aabb>& boxes, const std::vector<char>& active = {}, const std::vector<int>& kin = {});

  // New boxes for the same primitives. Keeps the order (refit) unless the summed surface area of
  // the nodes has grown by more than `growth` since the order was made. Returns true if re-ordered.
  bool update(const std::vector<Aabb>& boxes, double growth = 1.5);

  // Who is active from the next update on: one flag a primitive. Throws InputError if sizes disagree.
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
  // The number that all primitives below a group have in common; -1 if there is none.
  int kin(int level, int group) const { return kin_.empty() ? -1 : kin_[level_begin_[level] + group]; }
  // The primitives in the lanes of a group of level 0; -1 in lanes that hold none.
  const int* primitives(int group) const { return order_.data() + group * Box8::width; }

 private:
  void order_by_position(const std::vector<Aabb>& boxes);
  void lay_out_levels();
  void fill(const std::vector<Aabb>& boxes);
  void fill_kin();
  void fill_group(const std::vector<Aabb>& boxes, int level, int group);
  double node_area() const;

  std::vector<int> order_;  // padded with -1 to whole groups
  std::vector<char> primitive_active_;
  std::vector<int> level_begin_ = {
      0};  // first group of each level in the arrays below, and the end
  std::vector<Box8> boxes_;
  std::vector<Aabb> bounds_;
  std::vector<std::uint8_t> active_;
  std::vector<int> primitive_kin_, kin_;  // empty: no primitives are kin
  double built_area_ = 0.0;  // half areas summed [m^2]
};

}  // namespace tack
