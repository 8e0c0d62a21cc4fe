// Groups of unknown blocks, and the forces that each group bears: the scales by which residual
// forces are judged. Two partitions, as two questions are asked:
//   - Elements, joints and other terms whose stencils last connect the blocks of a *body group*: a
//     body, or several that are attached to each other. A residual force is small against the
//     largest stencil force of its body group; a contact counts for both groups that it is between.
//   - Contacts and other dynamic terms that transmit a force connect body groups to a *contact
//     group*. Forces with a cause (loads, elements, inertia) balance within it.
// Nothing outside its contact group changes the scale of a block.
#pragma once

#include <vector>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/core/disjoint_sets.hpp"
#include "framework/world/world.hpp"

namespace tack {

// The rounding error of the elements' forces, per vertex [N]: 64 roundings of the body group's
// largest coordinate, times the stiffness of the elements around the vertex at rest.
VecX rounding_forces(const World& world);

class ForceGroups {
 public:
  // Finds the body groups. rounding: per vertex [N]; empty: none.
  void begin_step(const World& world, const IncrementalPotential& potential, const VecX& rounding);
  // Finds the contact groups and all scales, of the stencils that were evaluated last.
  void measure(const IncrementalPotential& potential);

  int blocks() const { return static_cast<int>(body_group_.size()); }
  double rounding(int block) const { return rounding_[block]; }                  // N
  // The largest stencil force of its body group, contact included [N].
  double stencil_force(int block) const { return stencil_[body_group_[block]]; }
  // The largest load, element force or inertia force of the block's contact group [N].
  double cause(int block) const { return cause_[contact_group_[block]]; }
  // The largest mass of the block's contact group [kg].
  double heaviest(int block) const { return heaviest_[contact_group_[block]]; }
  int contact_group(int block) const { return contact_group_[block]; }  // its smallest block
  // Returns whether a stencil of the block's contact group ends at a fixed vertex, or some
  // directions of a block of the group are fixed.
  bool held(int block) const { return held_[contact_group_[block]]; }

 private:
  template <class Act>
  void for_each_block(int vertex, const Act& act) const;
  bool is_held(int vertex) const;

  const DofMap* dofs_ = nullptr;
  std::vector<int> body_group_, contact_group_;  // per block: the smallest block of the group
  std::vector<double> rounding_, load_, mass_;    // per block
  std::vector<double> stencil_, cause_, heaviest_;  // per group, at its smallest block
  // Per block whether a lasting stencil of it ends at a held vertex; per contact group.
  std::vector<char> own_held_, held_;
};

}  // namespace tack
