#include "framework/assembly/local_sums.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "framework/assembly/stencil_clamp.hpp"
#include "geometry/parallel.hpp"
#include "geometry/parallel_sort.hpp"
#include "geometry/prefix_sums.hpp"

namespace tack {
namespace {

constexpr int chunk_length = 512;  // stencils
static_assert(chunk_length % StencilRanges::grain == 0);

void add_block(const double* block, bool transposed, double* sum) {
  if (transposed) {
    Eigen::Map<Mat3>{sum} += Eigen::Map<const Mat3>(block).transpose();
  } else {
    Eigen::Map<Mat3>{sum} += Eigen::Map<const Mat3>(block);
  }
}

}  // namespace

void LocalSums::build(const std::vector<const StencilRanges*>& ranges, const std::vector<PlacedBatch>& batches,
                      const DofMap& dofs) {
  dofs_ = &dofs;
  batches_ = static_cast<int>(ranges.size());
  chunks_.clear();
  size_t blocks = 0;
  for (size_t b = 0; b < ranges.size(); ++b) {
    const StencilBatch& batch = batches[b].batch;
    for (int first = 0; first < batch.count; first += chunk_length) {
      const int last = std::min(first + chunk_length, batch.count);
      chunks_.push_back({ranges[b], static_cast<int>(b), batch, first, last,
                         static_cast<size_t>(batches[b].gradient_slot) + static_cast<size_t>(batch.arity) * first, blocks});
      blocks += static_cast<size_t>(hessian_blocks(batch.arity)) * (last - first);
    }
  }
  sum_of_.resize(blocks);

  std::vector<std::vector<BlockKey>> keys(chunks_.size());
  for_each(static_cast<int>(chunks_.size()), [&](int c) { keys[c] = number_sums(chunks_[c], dofs); }, 1);
  size_t sums = 0;
  for (size_t c = 0; c < chunks_.size(); ++c) {
    chunks_[c].sum = sums;
    chunks_[c].sums = keys[c].size();
    sums += keys[c].size();
  }
  sums_.resize(9 * sums);

  std::vector<std::pair<BlockKey, int>> all(sums);
  for_each(static_cast<int>(chunks_.size()), [&](int c) {
    for (size_t k = 0, at = chunks_[c].sum; k < keys[c].size(); ++k, ++at) all[at] = {keys[c][k], static_cast<int>(at)};
  }, 1);
  parallel_sort(all);
  group_sums(all);
}

// Makes the targets and their sources from all sums, which are sorted by key.
void LocalSums::group_sums(const std::vector<std::pair<BlockKey, int>>& all) {
  constexpr int chunk = 2048;
  const int n = static_cast<int>(all.size());
  const auto begins = [&](int i) { return i == 0 || all[i].first != all[i - 1].first; };
  std::vector<int> first_target(chunk_count(n, chunk) + 1, 0);
  for_each_chunk(n, [&](int c, int first, int last) {
    for (int i = first; i < last; ++i) first_target[c + 1] += begins(i);
  }, chunk);
  prefix_sums(first_target);
  targets_.resize(first_target.back());
  start_.resize(targets_.size() + 1);
  start_.back() = n;
  source_.resize(n);
  for_each_chunk(n, [&](int c, int first, int last) {
    int target = first_target[c];
    for (int i = first; i < last; ++i) {
      source_[i] = all[i].second;
      if (!begins(i)) continue;
      targets_[target] = all[i].first;
      start_[target++] = i;
    }
  }, chunk);
}

// The keys of the chunk's sums, sorted; each block of its stencils learns which of them is its own.
std::vector<BlockKey> LocalSums::number_sums(Chunk& chunk, const DofMap& dofs) {
  std::vector<BlockKey> keys;
  const auto for_each_block = [&](const auto& body) {
    size_t block = chunk.block;
    for (int s = chunk.first; s < chunk.last; ++s) {
      const int* v = chunk.batch.vertices + static_cast<size_t>(chunk.batch.arity) * s;
      for (int i = 0; i < chunk.batch.arity; ++i) {
        const int r = dofs.block(v[i]);
        for (int j = 0; j <= i; ++j, ++block) {
          const int c = dofs.block(v[j]);
          body(block, r >= 0 && c >= 0, block_key(std::max(r, c), std::min(r, c)), r < c);
        }
      }
    }
  };
  for_each_block([&](size_t, bool free, BlockKey key, bool) {
    if (free) keys.push_back(key);
  });
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for_each_block([&](size_t block, bool free, BlockKey key, bool transposed) {
    const auto sum = std::lower_bound(keys.begin(), keys.end(), key) - keys.begin();
    sum_of_[block] = free ? 2 * static_cast<int>(sum) + transposed : -1;
  });
  return keys;
}

void LocalSums::evaluate(const Chunk& chunk, const VecX& x, Projection projection, const std::vector<char>* clamp_at,
                         double* gradient_slots) {
  constexpr int grain = StencilRanges::grain;
  const int arity = chunk.batch.arity, blocks = hessian_blocks(arity);
  static thread_local std::vector<double> slots;
  slots.resize(9 * static_cast<size_t>(blocks) * grain);
  double* const sums = sums_.data() + 9 * chunk.sum;
  std::fill(sums, sums + 9 * chunk.sums, 0.0);
  const int* sum = sum_of_.data() + chunk.block;
  double* gradient = gradient_slots + 3 * chunk.gradient_slot;
  for (int first = chunk.first; first < chunk.last; first += grain, gradient += 3 * grain * arity) {
    const int last = std::min(first + grain, chunk.last);
    chunk.ranges->range_derivatives(x, projection, first, last, gradient, slots.data());
    const double* block = slots.data();
    if (clamp_at) clamp_stencils(chunk.batch, first, last, *clamp_at, *dofs_, slots.data());
    for (int k = 0; k < blocks * (last - first); ++k, ++sum, block += 9)
      if (*sum >= 0) add_block(block, *sum & 1, sums + 9 * static_cast<size_t>(*sum >> 1));
  }
}

void LocalSums::evaluate(const VecX& x, Projection projection, const std::vector<char>* clamp_at, double* gradient_slots,
                         std::vector<double>* seconds) {
  for_each_timed_chunk([&](const Chunk& chunk) { evaluate(chunk, x, projection, clamp_at, gradient_slots); }, seconds);
}

void LocalSums::evaluate_gradients(const VecX& x, double* gradient_slots, std::vector<double>* seconds) const {
  for_each_timed_chunk([&](const Chunk& chunk) {
    chunk.ranges->range_derivatives(x, Projection::none, chunk.first, chunk.last, gradient_slots + 3 * chunk.gradient_slot, nullptr);
  }, seconds);
}

// Calls body(chunk) for all chunks, in parallel.
template <class Body>
void LocalSums::for_each_timed_chunk(const Body& body, std::vector<double>* seconds) const {
  const int n = static_cast<int>(chunks_.size());
  if (!seconds) return for_each(n, [&](int c) { body(chunks_[c]); }, 1);
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); };
  std::vector<double> of_chunk(chunks_.size());
  const auto start = Clock::now();
  for_each(n, [&](int c) {
    const auto begun = Clock::now();
    body(chunks_[c]);
    of_chunk[c] = since(begun);
  }, 1);
  const double all = since(start);
  double sum = 0;
  seconds->assign(batches_, 0.0);
  for (size_t c = 0; c < chunks_.size(); ++c) (*seconds)[chunks_[c].number] += of_chunk[c], sum += of_chunk[c];
  for (double& of_batch : *seconds) of_batch *= sum > 0 ? all / sum : 0;
}

void LocalSums::gather(double scale, const std::vector<int>& positions, BlockMatrix& matrix) const {
  for_each(static_cast<int>(targets_.size()), [&](int k) {
    Mat3 total = Mat3::Zero();
    for (int e = start_[k]; e < start_[k + 1]; ++e)
      total += Eigen::Map<const Mat3>(sums_.data() + 9 * static_cast<size_t>(source_[e]));
    matrix.block(positions[k]) += scale * total;
  });
}

}  // namespace tack
