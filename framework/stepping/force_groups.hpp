// Groups of unknown blocks, and the forces that each group bears: the scales by which residual
// forces are judged. Two partitions, as two questions are asked:
//   - Elements, joints and other terms whose stencils last connect the blocks of a *body group*: a
//     body, or several that are attached to each other. A residual force is small against the
//     largest stencil force of its body group; a contact counts for both groups that it is between.
//   - Contacts and other dynamic terms that transmit a force connect body groups to a *contact
//     group*. Forces with a cause (loads, elements, inertia) balance within it.
// Nothing outside its contact group changes the scale of a block.
// Body groups are found once for a set of unknowns. Scales are maxima: threads take them in any
// order, with the same result.
#pragma once

#include <vector>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/core/concurrent_disjoint_sets.hpp"
#include "framework/world/world.hpp"

namespace tack {

// The rounding error of the elements' forces, per vertex [N]: 64 roundings of the body group's
// largest coordinate, times the stiffness of the elements around the vertex at rest.
VecX rounding_forces(const World& world);

class ForceGroups {
 public:
  // Finds the body groups of the world's unknowns, which are those of the potential. rounding: per
  // vertex [N]; empty: none.
  void begin_unknowns(const World& world, const IncrementalPotential& potential,
                      const VecX& rounding);
  // Takes the loads of the step.
  void begin_step(const World& world);
  // Finds the contact groups and all scales, of the stencils that were evaluated last.
  void measure(const IncrementalPotential& potential);

  int blocks() const { return static_cast<int>(group_of_block_.size()); }
  double rounding(int block) const { return rounding_[block]; }                  // N
  // The largest stencil force of its body group, contact included [N].
  double stencil_force(int block) const { return stencil_[group_of_block_[block]]; }
  // The largest load, element force or inertia force of the block's contact group [N].
  double cause(int block) const { return cause_[contact_root(block)]; }
  // The largest mass of the block's contact group [kg].
  double heaviest(int block) const { return heaviest_[contact_root(block)]; }
  // Returns the smallest block of the block's contact group.
  int contact_group(int block) const { return first_block_[contact_root(block)]; }
  // Returns whether a stencil of the block's contact group ends at a fixed vertex. Directions in
  // which a block is fixed do not count (DofMap::partly_fixed_blocks).
  bool held(int block) const { return held_[contact_root(block)]; }
  bool all_held() const { return free_ == 0; }

 private:
  int groups() const { return static_cast<int>(first_block_.size()); }
  int contact_root(int block) const { return contact_root_[group_of_block_[block]]; }
  void find_body_groups(const DofMap& dofs, const IncrementalPotential& potential);
  void find_held(const DofMap& dofs, const IncrementalPotential& potential);
  void measure_stencils(const IncrementalPotential& potential);

  std::vector<int> group_of_vertex_;  // its body group; -1: no unknown moves the vertex
  std::vector<double> rounding_;      // per block [N]
  // Body groups are numbered in the order of their smallest blocks.
  std::vector<int> group_of_block_, first_block_;
  // Per body group:
  std::vector<char> lastingly_held_;  // whether a lasting stencil ends at a fixed vertex
  std::vector<char> touches_fixed_;   // whether any stencil that transmits a force does
  std::vector<double> mass_, load_;                          // the largest [kg, N]
  // The largest forces, by the last measure [N]; stencil_: of elements and dynamic terms.
  std::vector<double> element_, dynamic_, inertia_, stencil_;
  ConcurrentDisjointSets contact_sets_;
  std::vector<int> contact_root_;  // the first body group of the contact group
  // Per contact group, at its first body group:
  std::vector<double> cause_, heaviest_;
  std::vector<char> held_;
  char free_ = 0;    // whether a contact group is not held
  VecX load_force_;  // per vertex (3n) [N]
};

}  // namespace tack
