// Reduced stencils: stencils that touch vertices moved by several unknowns, or several vertices
// moved by one, as stencils of unknown blocks with gradient W^T g and Hessian W^T K W. Stencils
// that touch equal sets of blocks (the contacts of two affine bodies) are merged into a few, so
// that the number of gathered slots grows with the pairs of bodies rather than with their contacts:
// sorted by a hash of the blocks, they form runs of equal blocks.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "framework/assembly/gather_map.hpp"

namespace tack {

/// Stencils in the unknowns instead of the vertices.
class ReducedStencils {
 public:
  /// Reduces these batches. Own slots begin at gradient_slot and hessian_slot.
  void assign_slots(const std::vector<PlacedBatch>& batches, const DofMap& dofs, int gradient_slot,
                    int hessian_slot);
  const std::vector<PlacedBatch>& batches() const { return batches_; }  // of blocks
  int gradient_end() const { return gradient_end_; }  // behind the last slot of its own
  int hessian_end() const { return hessian_end_; }

  /// Computes its slots from those of the stencils.
  /// hessian_slots: null if Hessians are not needed.
  void reduce(double* gradient_slots, double* hessian_slots) const;

 private:
  // A stencil that needs reduction.
  struct Stencil {
    const PlacedBatch* placed;
    int stencil;                  // of the batch
    std::span<const int> blocks;  // that move it, ascending
    size_t hash;                  // of the blocks
  };
  class StencilFinder;
  struct Run {
    size_t first_block = 0, blocks = 0;  // in blocks_
    size_t first = 0, last = 0;          // in members_
    int first_stencil = 0;               // in the order of the batches
    int gradient_slot = 0, hessian_slot = 0;

    bool operator<(const Run& other) const {
      return std::pair(blocks, first_stencil) < std::pair(other.blocks, other.first_stencil);
    }
  };
  struct Member {
    int arity, gradient_slot, hessian_slot;
    size_t first_weight;  // in weights_: of each vertex, those on all blocks of the run
  };

  void find_runs(const std::vector<Stencil>& stencils,
                 const std::vector<std::pair<size_t, int>>& order);
  void set_members(const std::vector<Stencil>& stencils,
                   const std::vector<std::pair<size_t, int>>& order, const DofMap& dofs);
  void reduce(const Run& run, double* gradient_slots, double* hessian_slots) const;

  std::vector<PlacedBatch> batches_;
  int gradient_end_ = 0, hessian_end_ = 0;
  std::vector<Run> runs_;  // by number of blocks
  std::vector<Member> members_;
  std::vector<int> blocks_;  // of the runs
  std::vector<double> weights_;
};

}  // namespace tack
