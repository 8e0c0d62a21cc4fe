#include "framework/stepping/force_groups.hpp"

#include <algorithm>
#include <limits>

namespace tack {
namespace {

constexpr double roundings = 64;  // of a coordinate, in the force of the elements around a vertex

std::vector<int> groups_of(DisjointSets& sets, int count) {
  std::vector<int> groups(count);
  for (int b = 0; b < count; ++b) groups[b] = sets.find(b);
  return groups;
}

void raise(double& largest, double value) { largest = std::max(largest, value); }

}  // namespace

VecX rounding_forces(const World& world) {
  const auto vertices = static_cast<int>(world.mass.size());
  std::vector<char> free(vertices);
  for (int v = 0; v < vertices; ++v) free[v] = world.script.ever_free(v);
  const DofMap dofs(free);
  std::vector<const Term*> elements;
  for (const auto& term : world.elastic_terms)
    if (term->stores()) elements.push_back(term.get());
  PhaseClock clock;  // nobody reads it
  IncrementalPotential potential(elements, dofs, world.mass, clock);
  VecX q;
  dofs.gather(world.rest, q);
  potential.begin_step(world.rest, world.rest, {}, false);
  potential.move_to(q);
  const BlockMatrix& hessian = potential.hessian({Projection::none});

  DisjointSets sets(vertices);
  potential.for_each_stencil_force([&](std::span<const int> stencil, double, bool) {
    for (const int v : stencil) sets.join(stencil[0], v);
  });
  std::vector<double> coordinate(vertices, 0);
  for (int v = 0; v < vertices; ++v) raise(coordinate[sets.find(v)], vertex(world.rest, v).lpNorm<Eigen::Infinity>());
  VecX forces = VecX::Zero(vertices);
  for (int c = 0; c < hessian.columns(); ++c) {
    const int v = dofs.vertex_of_block(c);
    const double stiffness = std::max(0.0, hessian.block(hessian.column_start[c]).diagonal().maxCoeff());
    forces(v) = roundings * std::numeric_limits<double>::epsilon() * stiffness * coordinate[sets.find(v)];
  }
  return forces;
}

// Calls act(block) for the blocks that move a vertex.
template <class Act>
void ForceGroups::for_each_block(int vertex, const Act& act) const {
  if (const int b = dofs_->block(vertex); b >= 0) return act(b);
  if (!dofs_->mixed(vertex)) return;
  for (const DofMap::Part& part : dofs_->blocks(vertex)) act(part.leaf);
}

// Returns whether no unknown moves the vertex.
bool ForceGroups::is_held(int vertex) const { return dofs_->block(vertex) < 0 && !dofs_->mixed(vertex); }

void ForceGroups::begin_step(const World& world, const IncrementalPotential& potential, const VecX& rounding) {
  dofs_ = &world.dofs;
  const int count = dofs_->block_count();
  DisjointSets sets(count);
  own_held_.assign(count, 0);
  potential.for_each_stencil_force([&](std::span<const int> stencil, double, bool dynamic) {
    if (dynamic) return;
    int first = -1;
    bool held = false;
    for (const int v : stencil) {
      for_each_block(v, [&](int b) { first < 0 ? void(first = b) : sets.join(first, b); });
      held = held || is_held(v);
    }
    if (first >= 0 && held) own_held_[first] = 1;
  });
  for (size_t k = 0; k < dofs_->dependents().size(); ++k) {
    const int v = dofs_->dependents()[k];
    if (!dofs_->mixed(v)) continue;
    const int first = dofs_->blocks(v)[0].leaf;
    for (const DofMap::Part& part : dofs_->blocks(v)) sets.join(first, part.leaf);
    for (const DofMap::Part& part : dofs_->parts(static_cast<int>(k)))
      if (is_held(part.leaf)) own_held_[first] = 1;
  }
  for (const DofMap::HeldBlock& h : dofs_->held_blocks())
    if (!h.twist) own_held_[h.block] = 1;
  body_group_ = groups_of(sets, count);

  rounding_.assign(count, 0);
  for (int v = 0; v < static_cast<int>(rounding.size()); ++v) {
    if (const int b = dofs_->block(v); b >= 0) rounding_[b] += rounding(v);
    else if (dofs_->mixed(v))
      for (const DofMap::Part& part : dofs_->blocks(v)) rounding_[part.leaf] += std::abs(part.weight) * rounding(v);
  }
  VecX load = VecX::Zero(world.rest.size());
  world.gravity_term.add_linear_gradient(load);
  world.load_term.add_linear_gradient(load);
  dofs_->collect(load);
  load_.resize(count);
  mass_.assign(count, 0);
  for (int b = 0; b < count; ++b) load_[b] = vertex(load, dofs_->vertex_of_block(b)).lpNorm<Eigen::Infinity>();
  for (int v = 0; v < static_cast<int>(world.mass.size()); ++v) for_each_block(v, [&](int b) { raise(mass_[b], world.mass(v)); });
}

void ForceGroups::measure(const IncrementalPotential& potential) {
  const int count = blocks();
  std::vector<double> element(count, 0);
  stencil_.assign(count, 0);
  DisjointSets sets(count);
  for (int b = 0; b < count; ++b) sets.join(b, body_group_[b]);
  std::vector<char> held = own_held_;
  potential.for_each_stencil_force([&](std::span<const int> stencil, double largest, bool dynamic) {
    int first = -1;
    bool ends_at_held = false;
    for (const int v : stencil) {
      ends_at_held = ends_at_held || is_held(v);
      for_each_block(v, [&](int b) {
        raise(stencil_[body_group_[b]], largest);
        if (!dynamic) raise(element[body_group_[b]], largest);
        else if (first >= 0 && largest > 0) sets.join(first, b);
        first = b;
      });
    }
    if (dynamic && first >= 0 && ends_at_held && largest > 0) held[first] = 1;
  });
  contact_group_ = groups_of(sets, count);
  held_.assign(count, 0);
  cause_.assign(count, 0);
  heaviest_.assign(count, 0);
  for (int b = 0; b < count; ++b) {
    raise(cause_[contact_group_[b]], std::max({load_[b], element[body_group_[b]], potential.inertial_force(b)}));
    raise(heaviest_[contact_group_[b]], mass_[b]);
    held_[contact_group_[b]] |= held[b];
  }
}

}  // namespace tack
