#include "framework/assembly/stencil_maps.hpp"

namespace tack {

StencilMaps::StencilMaps(std::span<const Term* const> terms, const DofMap& dofs) : dofs_(dofs), vertices_(dofs.vertex_count()), marked_(dofs.vertex_count(), 0) {
  vertices_of_block_ = VertexItems(dofs.block_count(), [&](const auto& act) {
    std::vector<int> blocks;
    for (int v = 0; v < vertices_; ++v) {
      blocks.clear();
      add_blocks_of(v, blocks);
      for (const int b : blocks) act(v, b);
    }
  });
  for (const Term* term : terms) {
    if (term->dynamic()) continue;
    Mapped& mapped = lasting_.emplace_back(Mapped{term, {}});
    for (const StencilBatch& batch : term->batches())
      mapped.batches.emplace_back(vertices_, [&](const auto& act) {
        for (int s = 0; s < batch.count; ++s)
          for (int k = 0; k < batch.arity; ++k) act(s, batch.vertices[static_cast<size_t>(batch.arity) * s + k]);
      });
  }
}

void StencilMaps::add_blocks_of(int v, std::vector<int>& blocks) const {
  if (dofs_.block(v) >= 0) blocks.push_back(dofs_.block(v));
  else if (dofs_.mixed(v))
    for (const DofMap::WeightedIndex& entry : dofs_.blocks(v)) blocks.push_back(entry.index);
}

std::vector<int> StencilMaps::with_neighbours(std::span<const int> blocks) const {
  std::vector<int> all(blocks.begin(), blocks.end());
  const std::vector<int> moved = moved_by(blocks);
  for (const Mapped& mapped : lasting_) {
    const std::vector<StencilBatch> batches = mapped.term->batches();
    for (size_t b = 0; b < batches.size(); ++b)
      for (const int s : mapped.batches[b].touching(moved))
        for (int k = 0; k < batches[b].arity; ++k) add_blocks_of(batches[b].vertices[static_cast<size_t>(batches[b].arity) * s + k], all);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<std::vector<int>> StencilMaps::touching(const Term& term, std::span<const int> vertices) {
  std::vector<std::vector<int>> found;
  for (const Mapped& mapped : lasting_) {
    if (mapped.term != &term) continue;
    for (const VertexItems& batch : mapped.batches) found.push_back(batch.touching(vertices));
    return found;
  }
  for (const int v : vertices) marked_[v] = 1;
  for (const StencilBatch& batch : term.batches()) {
    std::vector<int>& own = found.emplace_back();
    for (int s = 0; s < batch.count; ++s) {
      const int* const first = batch.vertices + static_cast<size_t>(batch.arity) * s;
      if (std::any_of(first, first + batch.arity, [&](int v) { return marked_[v] != 0; })) own.push_back(s);
    }
  }
  for (const int v : vertices) marked_[v] = 0;
  return found;
}

}  // namespace tack
