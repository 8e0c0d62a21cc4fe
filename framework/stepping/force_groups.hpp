// Groups of unknown blocks, and the forces within each group: the reference forces of the force
// residual. There are two partitions:
//   - A *body group* is connected by elements, joints and other terms with lasting stencils: one
//     body, or several that are attached to each other. Its largest stencil force is a reference; a
//     contact counts for both of its body groups.
//   - A *contact group* is a set of body groups that are connected by contacts or other dynamic
//     terms that transmit a force. Loads, element forces and inertia forces balance within it; the
//     largest of them is a reference.
// Forces outside of the contact group of a block do not change its reference forces. Body groups
// are found once for a set of unknowns. References are maxima, and thus the same for any number of
// threads.
#pragma once

#include <vector>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/core/concurrent_disjoint_sets.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns the rounding error of the element forces per vertex [N]: 64 roundings of the largest
// coordinate of the body group, times the stiffness of the elements around the vertex at rest.
VecX rounding_forces(const World& world);

class ForceGroups {
 public:
  // Finds the body groups of the world's unknowns, which are those of the potential. rounding: per
  // vertex [N]; empty: none.
  void begin_unknowns(const World& world, const IncrementalPotential& potential,
                      const VecX& rounding);
  // Evaluates the loads of the step.
  void begin_step(const World& world);
  // Finds the contact groups and all reference forces from the stencils that were evaluated last.
  void measure(const IncrementalPotential& potential);

  int blocks() const { return static_cast<int>(group_of_block_.size()); }
  // Returns the rounding error of the force on a block [N].
  double rounding(int block) const { return rounding_[block]; }
  // Returns the largest stencil force of the body group of a block, contact included [N].
  double stencil_force(int block) const { return stencil_[group_of_block_[block]]; }
  // Returns the largest load, element force or inertia force of the contact group of a block [N].
  double reference_force(int block) const { return reference_force_[contact_root(block)]; }
  // Returns the largest mass of the contact group of a block [kg].
  double largest_mass(int block) const { return largest_mass_[contact_root(block)]; }
  // Returns the smallest block of the contact group of a block.
  int contact_group(int block) const { return first_block_[contact_root(block)]; }
  // Returns whether a stencil of the contact group of a block has a fixed vertex. Fixed directions
  // of blocks do not count (DofMap::partly_fixed_blocks).
  bool supported(int block) const { return supported_[contact_root(block)]; }
  bool all_supported() const { return unsupported_ == 0; }

 private:
  int groups() const { return static_cast<int>(first_block_.size()); }
  int contact_root(int block) const { return contact_root_[group_of_block_[block]]; }
  void find_body_groups(const DofMap& dofs, const IncrementalPotential& potential);
  void find_supported(const DofMap& dofs, const IncrementalPotential& potential);
  void measure_stencils(const IncrementalPotential& potential);

  std::vector<int> group_of_vertex_;  // body group; -1: no unknown moves the vertex
  std::vector<double> rounding_;      // per block [N]
  // Body groups are numbered in the order of their smallest blocks.
  std::vector<int> group_of_block_, first_block_;
  // Per body group:
  std::vector<char> lastingly_supported_;  // whether a lasting stencil has a fixed vertex
  std::vector<char> touches_fixed_;        // whether any stencil that transmits a force has one
  std::vector<double> mass_, load_;        // the largest [kg, N]
  // The largest forces at the last measure() [N]; stencil_: of elements and dynamic terms.
  std::vector<double> element_, dynamic_, inertia_, stencil_;
  ConcurrentDisjointSets contact_sets_;
  std::vector<int> contact_root_;  // the first body group of the contact group
  // Per contact group, at its first body group:
  std::vector<double> reference_force_, largest_mass_;
  std::vector<char> supported_;
  char unsupported_ = 0;  // whether a contact group is not supported
  VecX load_force_;       // per vertex (3n) [N]
};

}  // namespace tack
