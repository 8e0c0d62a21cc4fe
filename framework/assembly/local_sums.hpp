// Hessians of lasting stencils, summed in two stages. (1) The stencils of a chunk are neighbours in
// the mesh: their blocks are summed while they are in the cache, which leaves a third of the slots
// or less. (2) The sums of all chunks are gathered in chunk order: equal bits for any number of
// threads.
#pragma once

#include <utility>
#include <vector>

#include "framework/assembly/gather_map.hpp"
#include "geometry/unset_array.hpp"

namespace tack {

/// Sums of Hessians by chunks of stencils.
class LocalSums {
 public:
  /// The ranges of each batch of stencils.
  void build(const std::vector<const StencilRanges*>& ranges,
             const std::vector<PlacedBatch>& batches, const DofMap& dofs);

  /// Returns the blocks of the matrix that the stencils touch, sorted.
  const std::vector<BlockKey>& targets() const { return targets_; }

  /// Sums the Hessians and writes all gradient slots. With flags, stencils that touch a flagged
  /// block of unknowns are clamped after `projection`. Sets the seconds of each batch, unless null:
  /// the total, divided in proportion to the times of its chunks.
  void evaluate(const VecX& x, Projection projection, const std::vector<char>* clamp_at,
                double* gradient_slots, std::vector<double>* seconds = nullptr);

  /// Writes all gradient slots. seconds: see evaluate().
  void evaluate_gradients(const VecX& x, double* gradient_slots,
                          std::vector<double>* seconds = nullptr) const;

  /// Adds scale * sums to the matrix, where target k is at positions[k].
  void gather(double scale, const std::vector<int>& positions, BlockMatrix& matrix) const;

 private:
  struct Chunk {
    const StencilRanges* ranges;
    int number;  // of the batch
    StencilBatch batch;
    int first, last;       // stencils of the batch
    size_t gradient_slot;  // of the first [3-vectors]
    size_t block;          // of the first, in `sum_of_`
    size_t sum = 0;        // the first of the chunk's sums
    size_t sums = 0;
  };

  std::vector<BlockKey> number_sums(Chunk& chunk, const DofMap& dofs);
  void group_sums(const std::vector<std::pair<BlockKey, int>>& all);
  template <class Body>
  void for_each_timed_chunk(const Body& body, std::vector<double>* seconds) const;
  void evaluate(const Chunk& chunk, const VecX& x, Projection projection,
                const std::vector<char>* clamp_at, double* gradient_slots);

  const DofMap* dofs_ = nullptr;
  int batches_ = 0;
  std::vector<Chunk> chunks_;
  // 2 * sum of the chunk + (1 if the block is to be transposed); -1: it is fixed
  std::vector<int> sum_of_;
  UnsetArray<double> sums_;  // 9 each
  std::vector<BlockKey> targets_;
  std::vector<int> start_, source_;  // target k gathers sums_ source_[start_[k] .. start_[k+1])
};

}  // namespace tack
