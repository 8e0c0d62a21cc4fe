#include "framework/core/dof_map.hpp"

namespace tack {

DofMap::DofMap(std::span<const char> movable) : block_of_(movable.size(), -1) {
  for (size_t i = 0; i < movable.size(); ++i) {
    if (!movable[i]) continue;
    block_of_[i] = static_cast<int>(vertex_of_.size());
    vertex_of_.push_back(static_cast<int>(i));
  }
}

void DofMap::gather(const VecX& x, VecX& q) const {
  q.resize(size());
  for (int b = 0; b < block_count(); ++b) q.segment<3>(3 * b) = vertex(x, vertex_of_[b]);
}

void DofMap::scatter(const VecX& q, VecX& x) const {
  for (int b = 0; b < block_count(); ++b) vertex(x, vertex_of_[b]) = q.segment<3>(3 * b);
}

}  // namespace tack
