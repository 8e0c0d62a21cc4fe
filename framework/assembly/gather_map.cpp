#include "framework/assembly/gather_map.hpp"

#include <tbb/parallel_sort.h>

#include <utility>

namespace tack {
namespace {

using Entry = std::pair<BlockKey, int>;  // target, slot

GatherMap group(std::vector<Entry> entries) {
  tbb::parallel_sort(entries.begin(), entries.end());  // slots are unique: a total order
  GatherMap map;
  map.slot.reserve(entries.size());
  for (const auto& [target, slot] : entries) {
    if (map.target.empty() || map.target.back() != target) {
      map.target.push_back(target);
      map.start.push_back(static_cast<int>(map.slot.size()));
    }
    map.slot.push_back(slot);
  }
  map.start.push_back(static_cast<int>(map.slot.size()));
  return map;
}

}  // namespace

GatherMap gradient_map(const std::vector<PlacedBatch>& batches, const DofMap& dofs) {
  std::vector<Entry> entries;
  for (const auto& [batch, first, unused] : batches) {
    for (int k = 0; k < batch.arity * batch.count; ++k) {
      const int block = dofs.block(batch.vertices[k]);
      if (block >= 0) entries.emplace_back(static_cast<BlockKey>(block), first + k);
    }
  }
  return group(std::move(entries));
}

GatherMap hessian_map(const std::vector<PlacedBatch>& batches, const DofMap& dofs) {
  std::vector<Entry> entries;
  for (const auto& [batch, unused, first] : batches) {
    int slot = first;
    for (int s = 0; s < batch.count; ++s) {
      const int* v = batch.vertices + batch.arity * s;
      for (int i = 0; i < batch.arity; ++i) {
        const int r = dofs.block(v[i]);
        for (int j = 0; j <= i; ++j, ++slot) {
          const int c = dofs.block(v[j]);
          if (r < 0 || c < 0) continue;
          entries.emplace_back(r >= c ? block_key(r, c) : block_key(c, r), 2 * slot + (r < c));
        }
      }
    }
  }
  return group(std::move(entries));
}

}  // namespace tack
