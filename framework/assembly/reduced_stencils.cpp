#include "framework/assembly/reduced_stencils.hpp"

#include <algorithm>

#include "geometry/parallel.hpp"
#include "geometry/parallel_sort.hpp"
#include "geometry/prefix_sums.hpp"

namespace tack {
namespace {

constexpr size_t longest_run = 64;  // stencils

// Appends the blocks that move a stencil, ascending.
void append_blocks(const StencilBatch& batch, int stencil, const DofMap& dofs, std::vector<int>& blocks) {
  const auto first = static_cast<std::ptrdiff_t>(blocks.size());
  for (int i = 0; i < batch.arity; ++i) {
    const int v = batch.vertices[static_cast<size_t>(batch.arity) * stencil + i];
    if (dofs.block(v) >= 0) blocks.push_back(dofs.block(v));
    else if (dofs.mixed(v))
      for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) blocks.push_back(entry.index);
  }
  std::sort(blocks.begin() + first, blocks.end());
  blocks.erase(std::unique(blocks.begin() + first, blocks.end()), blocks.end());
}

size_t hash_of(std::span<const int> blocks) {
  size_t h = blocks.size();
  for (const int b : blocks) h = (h ^ static_cast<size_t>(b)) * 0x9e3779b97f4a7c15u;
  return h;
}

}  // namespace

// Finds the stencils that need reduction, in the order of the batches. It owns their blocks.
class ReducedStencils::StencilFinder {
 public:
  StencilFinder(const std::vector<PlacedBatch>& batches, const DofMap& dofs) {
    for (const PlacedBatch& placed : batches)
      for (int first = 0; first < placed.batch.count; first += chunk_size)
        chunks_.push_back({&placed, first, std::min(first + chunk_size, placed.batch.count)});
    for_each(static_cast<int>(chunks_.size()), [&](int c) { find(chunks_[c], dofs); }, 1);
    std::vector<size_t> begin(chunks_.size() + 1, 0);
    for (size_t c = 0; c < chunks_.size(); ++c) begin[c + 1] = begin[c] + chunks_[c].stencils.size();
    stencils_.resize(begin.back());
    for_each(static_cast<int>(chunks_.size()), [&](int c) {
      std::copy(chunks_[c].stencils.begin(), chunks_[c].stencils.end(), stencils_.begin() + static_cast<std::ptrdiff_t>(begin[c]));
    }, 4);
  }
  const std::vector<Stencil>& stencils() const { return stencils_; }

 private:
  struct Chunk {
    const PlacedBatch* placed;
    int first, last;
    std::vector<Stencil> stencils = {};
    std::vector<int> blocks = {};
  };

  static void find(Chunk& chunk, const DofMap& dofs) {
    std::vector<size_t> end;  // of the blocks of each stencil
    for (int s = chunk.first; s < chunk.last; ++s) {
      if (!needs_reduction(chunk.placed->batch, s, dofs)) continue;
      append_blocks(chunk.placed->batch, s, dofs, chunk.blocks);
      chunk.stencils.push_back({chunk.placed, s, {}, 0});
      end.push_back(chunk.blocks.size());
    }
    for (size_t k = 0, first = 0; k < end.size(); first = end[k++]) {
      Stencil& stencil = chunk.stencils[k];
      stencil.blocks = std::span(chunk.blocks).subspan(first, end[k] - first);
      stencil.hash = hash_of(stencil.blocks);
    }
  }

  std::vector<Chunk> chunks_;
  std::vector<Stencil> stencils_;
};

// Finds runs of stencils of equal blocks, and sorts them by the number of blocks, then by their first stencil. order:
// hash and index of each stencil, sorted. Different sets of equal hash would only make more runs.
void ReducedStencils::find_runs(const std::vector<Stencil>& stencils, const std::vector<std::pair<size_t, int>>& order) {
  const int n = static_cast<int>(order.size());
  const auto blocks = [&](int k) { return stencils[order[k].second].blocks; };
  const auto begins = [&](int k) { return k == 0 || order[k].first != order[k - 1].first || !std::ranges::equal(blocks(k), blocks(k - 1)); };
  // Calls visit(k) for each beginning of a run in [first, last).
  const auto for_each_beginning = [&](int first, int last, const auto& visit) {
    const auto by_hash = [](const auto& a, const auto& b) { return a.first < b.first; };
    int set = static_cast<int>(std::lower_bound(order.begin(), order.begin() + first, order[first], by_hash) - order.begin());
    for (int k = first; k < last; ++k) {
      if (order[k].first != order[set].first) set = k;
      if ((k - set) % static_cast<int>(longest_run) == 0 || begins(k)) visit(k);
    }
  };
  std::vector<int> begin(chunk_count(n) + 1, 0);
  for_each_chunk(n, [&](int c, int first, int last) { for_each_beginning(first, last, [&](int) { ++begin[c + 1]; }); });
  prefix_sums(begin);
  runs_.assign(begin.back(), Run());
  for_each_chunk(n, [&](int c, int first, int last) {
    int r = begin[c];
    for_each_beginning(first, last, [&](int k) {
      Run& run = runs_[r++];
      run.blocks = blocks(k).size();
      run.first = k;
      run.first_stencil = order[k].second;
    });
  });
  for (size_t r = 0; r < runs_.size(); ++r) runs_[r].last = r + 1 < runs_.size() ? runs_[r + 1].first : n;
  parallel_sort(runs_);
  size_t count = 0;
  for (Run& run : runs_) {
    run.first_block = count;
    count += run.blocks;
  }
  blocks_.resize(count);
}

// Sets the blocks of the runs, and their members with weights.
void ReducedStencils::set_members(const std::vector<Stencil>& stencils, const std::vector<std::pair<size_t, int>>& order,
                                  const DofMap& dofs) {
  const int n = static_cast<int>(order.size());
  std::vector<size_t> first_weight(n + 1, 0);
  for_each(n, [&](int k) {
    const Stencil& s = stencils[order[k].second];
    first_weight[k + 1] = s.placed->batch.arity * s.blocks.size();
  });
  prefix_sums(first_weight);
  members_.resize(n);
  weights_.resize(first_weight.back());
  for_each(static_cast<int>(runs_.size()), [&](int r) {
    const Run& run = runs_[r];
    const std::span<const int> blocks = stencils[run.first_stencil].blocks;
    std::copy(blocks.begin(), blocks.end(), blocks_.begin() + static_cast<std::ptrdiff_t>(run.first_block));
    for (size_t k = run.first; k < run.last; ++k) {
      const Stencil& s = stencils[order[k].second];
      const StencilBatch& batch = s.placed->batch;
      members_[k] = {batch.arity, s.placed->gradient_slot + batch.arity * s.stencil,
                     s.placed->hessian_slot + hessian_blocks(batch.arity) * s.stencil, first_weight[k]};
      double* weights = weights_.data() + first_weight[k];
      std::fill(weights, weights + batch.arity * run.blocks, 0.0);
      for (int i = 0; i < batch.arity; ++i, weights += run.blocks) {
        const int v = batch.vertices[static_cast<size_t>(batch.arity) * s.stencil + i];
        const auto set = [&](int block, double weight) {
          weights[std::lower_bound(blocks.begin(), blocks.end(), block) - blocks.begin()] = weight;
        };
        if (dofs.block(v) >= 0) set(dofs.block(v), 1);
        else if (dofs.mixed(v))
          for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) set(entry.index, entry.weight);
      }
    }
  }, 4);
}

void ReducedStencils::assign_slots(const std::vector<PlacedBatch>& batches, const DofMap& dofs, int gradient_slot,
                            int hessian_slot) {
  batches_.clear();
  gradient_end_ = gradient_slot;
  hessian_end_ = hessian_slot;
  if (dofs.plain()) return;
  const StencilFinder finder(batches, dofs);
  const std::vector<Stencil>& stencils = finder.stencils();
  std::vector<std::pair<size_t, int>> order(stencils.size());
  for_each(static_cast<int>(order.size()), [&](int k) { order[k] = {stencils[k].hash, k}; });
  parallel_sort(order);
  find_runs(stencils, order);
  set_members(stencils, order, dofs);
  for (size_t r = 0; r < runs_.size();) {
    const int arity = static_cast<int>(runs_[r].blocks);
    PlacedBatch placed{{arity, 0, blocks_.data() + runs_[r].first_block}, gradient_end_, hessian_end_, true};
    for (; r < runs_.size() && static_cast<int>(runs_[r].blocks) == arity; ++r) {
      runs_[r].gradient_slot = gradient_end_ + arity * placed.batch.count;
      runs_[r].hessian_slot = hessian_end_ + hessian_blocks(arity) * placed.batch.count;
      ++placed.batch.count;
    }
    gradient_end_ += arity * placed.batch.count;
    hessian_end_ += hessian_blocks(arity) * placed.batch.count;
    batches_.push_back(placed);
  }
}

void ReducedStencils::reduce(const Run& run, double* gradient_slots, double* hessian_slots) const {
  const int n = static_cast<int>(run.blocks);
  const auto vec = [&](int slot) { return Eigen::Map<Vec3>(gradient_slots + 3 * static_cast<size_t>(slot)); };
  const auto mat = [&](int slot) { return Eigen::Map<Mat3>(hessian_slots + 9 * static_cast<size_t>(slot)); };
  std::fill_n(gradient_slots + 3 * static_cast<size_t>(run.gradient_slot), 3 * n, 0.0);
  if (hessian_slots) std::fill_n(hessian_slots + 9 * static_cast<size_t>(run.hessian_slot), 9 * hessian_blocks(n), 0.0);
  static thread_local std::vector<double> half;
  half.resize(9 * static_cast<size_t>(n));
  for (size_t m = run.first; m < run.last; ++m) {
    const Member& member = members_[m];
    const double* const weights = weights_.data() + member.first_weight;
    for (int i = 0; i < member.arity; ++i) {
      const double* const w = weights + static_cast<size_t>(n) * i;
      for (int b = 0; b < n; ++b)
        if (w[b] != 0) vec(run.gradient_slot + b) += w[b] * vec(member.gradient_slot + i);
      if (!hessian_slots) continue;
      // Row i of K W, then its summand of W^T K W.
      std::fill(half.begin(), half.end(), 0.0);
      for (int j = 0; j < member.arity; ++j) {
        const int slot = member.hessian_slot + std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j);
        const Mat3 k = j <= i ? Mat3(mat(slot)) : Mat3(mat(slot).transpose());
        const double* const v = weights + static_cast<size_t>(n) * j;
        for (int c = 0; c < n; ++c)
          if (v[c] != 0) Eigen::Map<Mat3>(half.data() + 9 * static_cast<size_t>(c)) += v[c] * k;
      }
      for (int b = 0; b < n; ++b) {
        if (w[b] == 0) continue;
        for (int c = 0; c <= b; ++c)
          mat(run.hessian_slot + hessian_blocks(b) + c) += w[b] * Eigen::Map<const Mat3>(half.data() + 9 * static_cast<size_t>(c));
      }
    }
  }
}

void ReducedStencils::reduce(double* gradient_slots, double* hessian_slots) const {
  for_each(static_cast<int>(runs_.size()), [&](int r) { reduce(runs_[r], gradient_slots, hessian_slots); }, 1);
}

}  // namespace tack
