#include "framework/assembly/reduced_stencils.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr size_t longest_run = 64;  // stencils

// Returns the blocks that move a stencil, ascending.
void blocks_of(const StencilBatch& batch, int stencil, const DofMap& dofs, std::vector<int>& blocks) {
  blocks.clear();
  for (int i = 0; i < batch.arity; ++i) {
    const int v = batch.vertices[static_cast<size_t>(batch.arity) * stencil + i];
    if (dofs.block(v) >= 0) blocks.push_back(dofs.block(v));
    else if (dofs.mixed(v))
      for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) blocks.push_back(entry.index);
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
}

}  // namespace

// Finds the run of a set of blocks by the hash of the blocks.
class ReducedStencils::RunFinder {
 public:
  explicit RunFinder(ReducedStencils& reduced) : reduced_(reduced) {}

  // Returns a run of the blocks that is not full, and counts one more stencil in it.
  int take(const std::vector<int>& blocks) {
    std::vector<int>& known = open_[hash(blocks)];
    for (int& r : known)
      if (same(reduced_.runs_[r], blocks)) {
        if (reduced_.runs_[r].count == longest_run) r = start(blocks, reduced_.runs_[r].first_block);
        ++reduced_.runs_[r].count;
        return r;
      }
    const size_t first_block = reduced_.blocks_.size();
    reduced_.blocks_.insert(reduced_.blocks_.end(), blocks.begin(), blocks.end());
    known.push_back(start(blocks, first_block));
    ++reduced_.runs_.back().count;
    return known.back();
  }

 private:
  static size_t hash(const std::vector<int>& blocks) {
    size_t h = blocks.size();
    for (const int b : blocks) h = (h ^ static_cast<size_t>(b)) * 0x9e3779b97f4a7c15u;
    return h;
  }
  bool same(const Run& run, const std::vector<int>& blocks) const {
    return run.blocks == blocks.size() &&
           std::equal(blocks.begin(), blocks.end(), reduced_.blocks_.begin() + static_cast<std::ptrdiff_t>(run.first_block));
  }
  int start(const std::vector<int>& blocks, size_t first_block) {
    reduced_.runs_.push_back({first_block, blocks.size()});
    return static_cast<int>(reduced_.runs_.size()) - 1;
  }

  ReducedStencils& reduced_;
  std::unordered_map<size_t, std::vector<int>> open_;  // the last run of each set of blocks, by hash
};

void ReducedStencils::find_runs(const std::vector<PlacedBatch>& batches, const DofMap& dofs) {
  runs_.clear();
  blocks_.clear();
  struct PlacedStencil {
    const PlacedBatch* placed;
    int stencil, run;
  };
  std::vector<PlacedStencil> found;
  std::vector<int> blocks;
  RunFinder finder(*this);
  for (const PlacedBatch& placed : batches)
    for (int s = 0; s < placed.batch.count; ++s) {
      if (!needs_reduction(placed.batch, s, dofs)) continue;
      blocks_of(placed.batch, s, dofs, blocks);
      found.push_back({&placed, s, finder.take(blocks)});
    }
  size_t member = 0;
  for (Run& run : runs_) {
    run.first = run.last = member;
    member += run.count;
  }
  members_.resize(member);
  weights_.clear();
  for (const PlacedStencil& f : found) members_[runs_[f.run].last++] = member_of(*f.placed, f.stencil, dofs, runs_[f.run]);
}

ReducedStencils::Member ReducedStencils::member_of(const PlacedBatch& placed, int stencil, const DofMap& dofs,
                                                   const Run& run) {
  const StencilBatch& batch = placed.batch;
  const Member member{batch.arity, placed.gradient_slot + batch.arity * stencil,
                      placed.hessian_slot + hessian_blocks(batch.arity) * stencil, weights_.size()};
  weights_.resize(weights_.size() + batch.arity * run.blocks);
  double* weights = weights_.data() + member.first_weight;
  const int* const first = blocks_.data() + run.first_block;
  for (int i = 0; i < batch.arity; ++i, weights += run.blocks) {
    const int v = batch.vertices[static_cast<size_t>(batch.arity) * stencil + i];
    const auto set = [&](int block, double weight) {
      weights[std::lower_bound(first, first + run.blocks, block) - first] = weight;
    };
    if (dofs.block(v) >= 0) set(dofs.block(v), 1);
    else if (dofs.mixed(v))
      for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) set(entry.index, entry.weight);
  }
  return member;
}

void ReducedStencils::assign_slots(const std::vector<PlacedBatch>& batches, const DofMap& dofs, int gradient_slot,
                            int hessian_slot) {
  batches_.clear();
  gradient_end_ = gradient_slot;
  hessian_end_ = hessian_slot;
  if (dofs.plain()) return;
  find_runs(batches, dofs);
  std::stable_sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.blocks < b.blocks; });
  std::vector<int> sorted;
  for (Run& run : runs_) {
    const auto from = blocks_.begin() + static_cast<std::ptrdiff_t>(run.first_block);
    sorted.insert(sorted.end(), from, from + static_cast<std::ptrdiff_t>(run.blocks));
    run.first_block = sorted.size() - run.blocks;
  }
  blocks_ = std::move(sorted);
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
