#include "framework/core/dof_map.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/independent_vertices.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int blocks_per_chunk = 2048;     // copying that many takes 5 to 10 us
constexpr int dependents_per_chunk = 512;  // of affine frames: 5 us

}  // namespace

DofMap::DofMap(std::span<const char> movable, const Dependences& dependences, const std::vector<FixedDirections>& fixed)
    : block_of_(movable.size(), -1) {
  IndependentVertices independent(static_cast<int>(dependences.empty() ? 0 : movable.size()), dependences);
  const auto depends = [&](int v) { return !dependences.empty() && independent.depends(v); };
  for (int i = 0; i < vertex_count(); ++i) {
    if (depends(i)) dependents_.push_back(i);
    if (!movable[i] || depends(i)) continue;
    block_of_[i] = static_cast<int>(vertex_of_.size());
    vertex_of_.push_back(i);
  }
  for (const int v : dependents_) {
    std::vector<WeightedIndex> blocks;
    for (const auto& [vertex, weight] : independent.of(v)) {
      independents_.push_back({vertex, weight});
      if (block_of_[vertex] >= 0) blocks.push_back({block_of_[vertex], weight});
    }
    start_.push_back(static_cast<int>(independents_.size()));
    if (blocks.empty()) continue;
    const bool shared = blocks.size() == 1 && blocks[0].weight == 1 && start_.back() - start_[start_.size() - 2] == 1;
    if (shared) {
      block_of_[v] = blocks[0].index;
      shares_ = true;
      continue;
    }
    if (mixed_.empty()) {
      mixed_.assign(movable.size(), 0);
      block_entry_.assign(movable.size(), -1);
    }
    mixed_[v] = 1;
    block_entry_[v] = static_cast<int>(block_start_.size()) - 1;
    weighted_blocks_.insert(weighted_blocks_.end(), blocks.begin(), blocks.end());
    block_start_.push_back(static_cast<int>(weighted_blocks_.size()));
  }
  for (const FixedDirections& h : fixed)
    if (owns(h.vertex)) partly_fixed_blocks_.push_back({block_of_[h.vertex], h.projection, h.scalar});
  std::sort(partly_fixed_blocks_.begin(), partly_fixed_blocks_.end(), [](const PartlyFixedBlock& a, const PartlyFixedBlock& b) { return a.block < b.block; });
}

void DofMap::gather(const VecX& x, VecX& q) const {
  q.resize(size());
  for_each(block_count(), [&](int b) { q.segment<3>(3 * b) = vertex(x, vertex_of_[b]); }, blocks_per_chunk);
}

void DofMap::scatter(const VecX& q, VecX& x) const {
  std::vector<Vec3> fixed;
  for (const PartlyFixedBlock& h : partly_fixed_blocks_) fixed.emplace_back(h.projection * (vertex(x, vertex_of_[h.block]) - q.segment<3>(3 * h.block)));
  for_each(block_count(), [&](int b) { vertex(x, vertex_of_[b]) = q.segment<3>(3 * b); }, blocks_per_chunk);
  for (size_t i = 0; i < fixed.size(); ++i) vertex(x, vertex_of_[partly_fixed_blocks_[i].block]) += fixed[i];
  update_dependents(x);
}

void DofMap::project_out_fixed_directions(VecX& gradient) const {
  for (const PartlyFixedBlock& h : partly_fixed_blocks_) gradient.segment<3>(3 * h.block) -= (h.projection * gradient.segment<3>(3 * h.block)).eval();
}

VecX DofMap::to_unknowns(VecX& full) const {
  move_to_independents(full);
  VecX own;
  gather(full, own);
  project_out_fixed_directions(own);
  return own;
}

void DofMap::copy_fixed_directions(const VecX& x, VecX& q) const {
  for (const PartlyFixedBlock& h : partly_fixed_blocks_)
    q.segment<3>(3 * h.block) += h.projection * (vertex(x, vertex_of_[h.block]) - q.segment<3>(3 * h.block));
}

void DofMap::update_dependents(VecX& x) const {
  for_each(static_cast<int>(dependents_.size()), [&](int k) {
    Vec3 sum = Vec3::Zero();
    for (const WeightedIndex& entry : independents(k)) sum += entry.weight * vertex(x, entry.index);
    vertex(x, dependents_[k]) = sum;
  }, dependents_per_chunk);
}

Dependences DofMap::dependences() const {
  Dependences all;
  for (size_t k = 0; k < dependents_.size(); ++k) {
    Dependence& d = all.emplace_back(Dependence{dependents_[k], {}});
    for (const WeightedIndex& entry : independents(static_cast<int>(k))) d.on.emplace_back(entry.index, entry.weight);
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
      for (const WeightedIndex& entry : blocks(v)) sum(entry.index) += entry.weight * entry.weight * mass(v);
  return sum;
}

void DofMap::move_to_independents(VecX& forces) const {
  for (size_t k = 0; k < dependents_.size(); ++k) {
    const Vec3 force = vertex(forces, dependents_[k]);
    for (const WeightedIndex& entry : independents(static_cast<int>(k))) vertex(forces, entry.index) += entry.weight * force;
    vertex(forces, dependents_[k]).setZero();
  }
}

}  // namespace tack
