#include "framework/assembly/gather_map.hpp"

#include <algorithm>
#include <utility>

#include "geometry/parallel.hpp"
#include "geometry/prefix_sums.hpp"

namespace tack {
namespace {

constexpr int columns_per_chunk = 1024;  // of loops over their counts

// A run of stencils of one batch.
struct Run {
  const PlacedBatch* placed;
  int first, last;
};

// Returns at most a few dozen runs, because each run counts the entries of every column.
std::vector<Run> runs_of(const std::vector<PlacedBatch>& batches) {
  constexpr int shortest = 2048, most = 16;
  int total = 0;
  for (const PlacedBatch& placed : batches) total += placed.batch.count;
  const int length = std::max(shortest, (total + most - 1) / most);
  std::vector<Run> runs;
  for (const PlacedBatch& placed : batches)
    for (int first = 0; first < placed.batch.count; first += length)
      runs.push_back({&placed, first, std::min(first + length, placed.batch.count)});
  return runs;
}

struct Entry {
  int row, slot;
  bool operator<(const Entry& other) const {
    return row != other.row ? row < other.row : slot < other.slot;
  }
};

// The entries of all stencils by column, and where each column's start.
struct Columns {
  std::vector<Entry> entries;
  std::vector<int> start;
};

// Counting sort; visit(placed batch, stencil, emit(column, row, slot)) lists a stencil's entries.
template <class Visit>
Columns by_column(const std::vector<PlacedBatch>& batches, int columns, const Visit& visit) {
  const std::vector<Run> runs = runs_of(batches);
  std::vector<std::vector<int>> next(runs.size());
  for_each(static_cast<int>(runs.size()), [&](int r) {
    next[r].assign(columns, 0);
    for (int s = runs[r].first; s < runs[r].last; ++s)
      visit(*runs[r].placed, s, [&](int column, int, int) { ++next[r][column]; });
  }, 1);
  Columns sorted;
  sorted.start.resize(columns + 1);
  // Offsets within chunks of columns first: a pass over all counts is the longest part.
  std::vector<int> chunk_begin(chunk_count(columns, columns_per_chunk) + 1, 0);
  for_each_chunk(columns, [&](int k, int first, int last) {
    int at = 0;
    for (int c = first; c < last; ++c) {
      sorted.start[c] = at;
      for (auto& counts : next) at += std::exchange(counts[c], at);
    }
    chunk_begin[k + 1] = at;
  }, columns_per_chunk);
  prefix_sums(chunk_begin);
  for_each_chunk(columns, [&](int k, int first, int last) {
    for (int c = first; c < last; ++c) sorted.start[c] += chunk_begin[k];
  }, columns_per_chunk);
  sorted.start.back() = chunk_begin.back();
  sorted.entries.resize(sorted.start.back());
  for_each(static_cast<int>(runs.size()), [&](int r) {
    for (int s = runs[r].first; s < runs[r].last; ++s)
      visit(*runs[r].placed, s, [&](int column, int row, int slot) {
        sorted.entries[chunk_begin[column / columns_per_chunk] + next[r][column]++] = {row, slot};
      });
  }, 1);
  return sorted;
}

// Sorts each column by row and counts its distinct rows.
std::vector<int> sort_columns(Columns& sorted, int columns) {
  std::vector<int> targets(columns + 1, 0);
  for_each(columns, [&](int c) {
    const auto begin = sorted.entries.begin() + sorted.start[c];
    const auto end = sorted.entries.begin() + sorted.start[c + 1];
    std::sort(begin, end);
    int distinct = 0;
    for (auto e = begin; e != end; ++e) distinct += e == begin || e->row != (e - 1)->row;
    targets[c + 1] = distinct;
  }, 64);
  prefix_sums(targets);
  return targets;
}

// key(column, row) names a target.
template <class Visit, class Key>
GatherMap group(const std::vector<PlacedBatch>& batches, int columns, const Visit& visit, const Key& key) {
  GatherMap map;
  if (batches.empty()) {
    map.start.push_back(0);
    return map;
  }
  Columns sorted = by_column(batches, columns, visit);
  const std::vector<int> first_target = sort_columns(sorted, columns);
  map.target.resize(first_target.back());
  map.start.resize(first_target.back() + 1);
  map.slot.resize(sorted.entries.size());
  map.start.back() = static_cast<int>(sorted.entries.size());
  for_each(columns, [&](int c) {
    int target = first_target[c] - 1;
    for (int e = sorted.start[c]; e < sorted.start[c + 1]; ++e) {
      const Entry& entry = sorted.entries[e];
      if (e == sorted.start[c] || entry.row != sorted.entries[e - 1].row) {
        map.target[++target] = key(c, entry.row);
        map.start[target] = e;
      }
      map.slot[e] = entry.slot;
    }
  }, 64);
  return map;
}

bool left_out(const PlacedBatch& placed, int stencil, const DofMap& dofs) {
  return !placed.of_blocks && needs_reduction(placed.batch, stencil, dofs);
}

int block_of(const PlacedBatch& placed, int entry, const DofMap& dofs) {
  const int v = placed.batch.vertices[entry];
  return placed.of_blocks ? v : dofs.block(v);
}

}  // namespace

bool needs_reduction(const StencilBatch& batch, int stencil, const DofMap& dofs) {
  if (dofs.plain()) return false;
  const int* const v = batch.vertices + static_cast<size_t>(batch.arity) * stencil;
  for (int i = 0; i < batch.arity; ++i) {
    if (dofs.mixed(v[i])) return true;
    for (int j = 0; j < i; ++j)
      if (dofs.block(v[i]) >= 0 && dofs.block(v[i]) == dofs.block(v[j])) return true;
  }
  return false;
}

GatherMap gradient_map(const std::vector<PlacedBatch>& batches, const DofMap& dofs) {
  const auto visit = [&](const PlacedBatch& placed, int stencil, const auto& emit) {
    const int arity = placed.batch.arity;
    if (left_out(placed, stencil, dofs)) return;
    for (int k = arity * stencil; k < arity * (stencil + 1); ++k) {
      const int block = block_of(placed, k, dofs);
      if (block >= 0) emit(block, 0, placed.gradient_slot + k);
    }
  };
  return group(batches, dofs.block_count(), visit,
               [](int column, int) { return static_cast<BlockKey>(column); });
}

GatherMap hessian_map(const std::vector<PlacedBatch>& batches, const DofMap& dofs) {
  const auto visit = [&](const PlacedBatch& placed, int stencil, const auto& emit) {
    const int arity = placed.batch.arity;
    if (left_out(placed, stencil, dofs)) return;
    int slot = placed.hessian_slot + hessian_blocks(arity) * stencil;
    for (int i = 0; i < arity; ++i) {
      const int r = block_of(placed, arity * stencil + i, dofs);
      for (int j = 0; j <= i; ++j, ++slot) {
        const int c = block_of(placed, arity * stencil + j, dofs);
        if (r >= 0 && c >= 0) emit(std::min(r, c), std::max(r, c), 2 * slot + (r < c));
      }
    }
  };
  return group(batches, dofs.block_count(), visit,
               [](int column, int row) { return block_key(row, column); });
}

}  // namespace tack
