#include "framework/core/dof_map.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/leaves.hpp"

namespace tack {

DofMap::DofMap(std::span<const char> movable, const Dependences& dependences, const std::vector<HeldDirections>& held)
    : block_of_(movable.size(), -1) {
  Leaves leaves(static_cast<int>(dependences.empty() ? 0 : movable.size()), dependences);
  const auto depends = [&](int v) { return !dependences.empty() && leaves.depends(v); };
  for (int i = 0; i < vertex_count(); ++i) {
    if (depends(i)) dependents_.push_back(i);
    if (!movable[i] || depends(i)) continue;
    block_of_[i] = static_cast<int>(vertex_of_.size());
    vertex_of_.push_back(i);
  }
  for (const int v : dependents_) {
    std::vector<Part> blocks;
    for (const auto& [leaf, weight] : leaves.of(v)) {
      parts_.push_back({leaf, weight});
      if (block_of_[leaf] >= 0) blocks.push_back({block_of_[leaf], weight});
    }
    start_.push_back(static_cast<int>(parts_.size()));
    if (blocks.empty()) continue;
    const bool shared = blocks.size() == 1 && blocks[0].weight == 1 && start_.back() - start_[start_.size() - 2] == 1;
    if (shared) {
      block_of_[v] = blocks[0].leaf;
      shares_ = true;
      continue;
    }
    if (mixed_.empty()) {
      mixed_.assign(movable.size(), 0);
      block_entry_.assign(movable.size(), -1);
    }
    mixed_[v] = 1;
    block_entry_[v] = static_cast<int>(block_start_.size()) - 1;
    block_parts_.insert(block_parts_.end(), blocks.begin(), blocks.end());
    block_start_.push_back(static_cast<int>(block_parts_.size()));
  }
  for (const HeldDirections& h : held)
    if (owns(h.vertex)) held_blocks_.push_back({block_of_[h.vertex], h.held, h.twist});
  std::sort(held_blocks_.begin(), held_blocks_.end(), [](const HeldBlock& a, const HeldBlock& b) { return a.block < b.block; });
}

void DofMap::gather(const VecX& x, VecX& q) const {
  q.resize(size());
  for (int b = 0; b < block_count(); ++b) q.segment<3>(3 * b) = vertex(x, vertex_of_[b]);
}

void DofMap::scatter(const VecX& q, VecX& x) const {
  std::vector<Vec3> kept;
  for (const HeldBlock& h : held_blocks_) kept.emplace_back(h.held * (vertex(x, vertex_of_[h.block]) - q.segment<3>(3 * h.block)));
  for (int b = 0; b < block_count(); ++b) vertex(x, vertex_of_[b]) = q.segment<3>(3 * b);
  for (size_t i = 0; i < kept.size(); ++i) vertex(x, vertex_of_[held_blocks_[i].block]) += kept[i];
  follow(x);
}

void DofMap::keep_held(const VecX& x, VecX& q) const {
  for (const HeldBlock& h : held_blocks_)
    q.segment<3>(3 * h.block) += h.held * (vertex(x, vertex_of_[h.block]) - q.segment<3>(3 * h.block));
}

void DofMap::follow(VecX& x) const {
  for (size_t k = 0; k < dependents_.size(); ++k) {
    Vec3 sum = Vec3::Zero();
    for (const Part& part : parts(static_cast<int>(k))) sum += part.weight * vertex(x, part.leaf);
    vertex(x, dependents_[k]) = sum;
  }
}

Dependences DofMap::dependences() const {
  Dependences all;
  for (size_t k = 0; k < dependents_.size(); ++k) {
    Dependence& d = all.emplace_back(Dependence{dependents_[k], {}});
    for (const Part& part : parts(static_cast<int>(k))) d.on.emplace_back(part.leaf, part.weight);
  }
  return all;
}

VecX DofMap::own_masses(const VecX& mass) const {
  VecX sum = VecX::Zero(block_count());
  for (int v = 0; v < vertex_count(); ++v)
    if (block_of_[v] >= 0) sum(block_of_[v]) += mass(v);
  return sum;
}

VecX DofMap::block_masses(const VecX& mass) const {
  VecX sum = own_masses(mass);
  for (int v = 0; v < vertex_count(); ++v)
    if (mixed(v))
      for (const Part& part : blocks(v)) sum(part.leaf) += part.weight * part.weight * mass(v);
  return sum;
}

void DofMap::collect(VecX& forces) const {
  for (size_t k = 0; k < dependents_.size(); ++k) {
    const Vec3 force = vertex(forces, dependents_[k]);
    for (const Part& part : parts(static_cast<int>(k))) vertex(forces, part.leaf) += part.weight * force;
    vertex(forces, dependents_[k]).setZero();
  }
}

}  // namespace tack
