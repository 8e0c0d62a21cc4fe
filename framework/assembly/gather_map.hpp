// Gather map: for each target (a gradient block or a Hessian block), the slots whose sum it is, in
// a fixed order. Gathering is parallel over targets, without atomics, so that sums have equal bits
// for any number of threads.
#pragma once

#include <vector>

#include "framework/assembly/block_pattern.hpp"
#include "framework/core/dof_map.hpp"
#include "framework/core/term.hpp"

namespace tack {

/// One batch of a term and the position of its first slots.
struct PlacedBatch {
  StencilBatch batch;
  int gradient_slot = 0;   // in 3-vectors
  int hessian_slot = 0;    // in 3x3 blocks
  bool of_blocks = false;  // its `vertices` are unknown blocks
};

/// Returns true if the slots are no blocks of the matrix: several unknowns move a vertex of the
/// stencil, or one unknown moves several.
bool needs_reduction(const StencilBatch& batch, int stencil, const DofMap& dofs);

/// Target k sums slots slot[start[k] .. start[k+1]).
struct GatherMap {
  std::vector<BlockKey> target;  // sorted; for gradients the block index
  std::vector<int> start;
  std::vector<int> slot;  // Hessian maps: 2 * slot + (1 if the block is to be transposed)

  int targets() const { return static_cast<int>(target.size()); }
};

/// Skips stencils that need reduction (reduced_stencils.hpp).
GatherMap gradient_map(const std::vector<PlacedBatch>& batches, const DofMap& dofs);
GatherMap hessian_map(const std::vector<PlacedBatch>& batches, const DofMap& dofs);

}  // namespace tack
