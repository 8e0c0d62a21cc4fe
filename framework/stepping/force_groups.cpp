#include "framework/stepping/force_groups.hpp"

#include <algorithm>
#include <limits>

#include "framework/core/concurrent_maximum.hpp"
#include "framework/core/dependent_sets.hpp"
#include "framework/core/disjoint_sets.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr double roundings = 64;  // of a coordinate, in the force of the elements around a vertex

}  // namespace

VecX rounding_forces(const World& world) {
  const auto vertices = static_cast<int>(world.mass.size());
  std::vector<char> free(vertices);
  for (int v = 0; v < vertices; ++v) free[v] = world.prescribed_motion.ever_free(v);
  const DofMap dofs(free);
  std::vector<const Term*> elements;
  for (const auto& term : world.elastic_terms)
    if (term->stores()) elements.push_back(term.get());
  PhaseClock clock;  // unused
  IncrementalPotential potential(elements, dofs, world.mass, clock);
  VecX q;
  dofs.gather(world.rest, q);
  potential.begin_step(world.rest, world.rest, {}, false);
  potential.move_to(q);
  const BlockMatrix& hessian = potential.hessian({Projection::none});

  DisjointSets sets(vertices);
  potential.for_each_lasting_stencil([&](std::span<const int> stencil) {
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

void ForceGroups::begin_unknowns(const World& world, const IncrementalPotential& potential, const VecX& rounding) {
  const DofMap& dofs = world.dofs;
  find_body_groups(dofs, potential);
  find_supported(dofs, potential);
  rounding_.assign(dofs.block_count(), 0);
  mass_.assign(groups(), 0);
  for (int v = 0; v < dofs.vertex_count(); ++v) {
    if (group_of_vertex_[v] < 0) continue;
    raise(mass_[group_of_vertex_[v]], world.mass(v));
    if (rounding.size() == 0) continue;
    if (const int b = dofs.block(v); b >= 0) rounding_[b] += rounding(v);
    else
      for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) rounding_[entry.index] += std::abs(entry.weight) * rounding(v);
  }
}

void ForceGroups::find_body_groups(const DofMap& dofs, const IncrementalPotential& potential) {
  const int count = dofs.block_count();
  DisjointSets sets(count);
  std::vector<int> block(dofs.vertex_count());  // a block that moves the vertex; -1: none
  for (int v = 0; v < dofs.vertex_count(); ++v) block[v] = dofs.mixed(v) ? dofs.blocks(v)[0].index : dofs.block(v);
  join_dependent(dofs, block, sets);
  potential.for_each_lasting_stencil([&](std::span<const int> stencil) {
    int first = -1;
    for (const int v : stencil) {
      if (block[v] < 0) continue;
      if (first >= 0) sets.join(first, block[v]);
      first = block[v];
    }
  });
  group_of_block_.resize(count);
  first_block_.clear();
  for (int b = 0; b < count; ++b) {
    const int smallest = sets.find(b);
    if (smallest == b) first_block_.push_back(b);
    group_of_block_[b] = smallest == b ? groups() - 1 : group_of_block_[smallest];
  }
  group_of_vertex_.resize(block.size());
  for (size_t v = 0; v < block.size(); ++v) group_of_vertex_[v] = block[v] < 0 ? -1 : group_of_block_[block[v]];
}

void ForceGroups::find_supported(const DofMap& dofs, const IncrementalPotential& potential) {
  lastingly_supported_.assign(groups(), 0);
  const auto mark_if_fixed = [&](const auto& vertices, const auto& vertex_of) {
    int group = -1;
    bool fixed = false;
    for (const auto& entry : vertices) {
      const int of_vertex = group_of_vertex_[vertex_of(entry)];
      group = std::max(group, of_vertex);
      fixed = fixed || of_vertex < 0;
    }
    if (group >= 0 && fixed) lastingly_supported_[group] = 1;
  };
  potential.for_each_lasting_stencil([&](std::span<const int> stencil) { mark_if_fixed(stencil, [](int v) { return v; }); });
  for (size_t k = 0; k < dofs.dependents().size(); ++k)
    if (dofs.mixed(dofs.dependents()[k])) mark_if_fixed(dofs.independents(static_cast<int>(k)), [](const DofMap::WeightedIndex& entry) { return entry.index; });
}

void ForceGroups::begin_step(const World& world) {
  load_force_.setZero(world.rest.size());
  world.gravity_term.add_linear_gradient(load_force_);
  world.load_term.add_linear_gradient(load_force_);
  world.dofs.move_to_independents(load_force_);
  load_.assign(groups(), 0);
  for_each(blocks(), [&](int b) {
    raise(load_[group_of_block_[b]], vertex(load_force_, world.dofs.vertex_of_block(b)).lpNorm<Eigen::Infinity>());
  });
}

void ForceGroups::measure_stencils(const IncrementalPotential& potential) {
  element_.assign(groups(), 0);
  dynamic_.assign(groups(), 0);
  touches_fixed_ = lastingly_supported_;
  contact_sets_.reset(groups());
  potential.for_each_stencil_force([&](std::span<const int> stencil, double largest, bool dynamic) {
    int last = -1;
    bool fixed = false;
    for (const int v : stencil) {
      const int group = group_of_vertex_[v];
      fixed = fixed || group < 0;
      if (group < 0 || group == last) continue;
      raise((dynamic ? dynamic_ : element_)[group], largest);
      if (!dynamic) return;  // its moving vertices belong to one body group
      if (last >= 0 && largest > 0) contact_sets_.join(last, group);
      last = group;
    }
    if (last >= 0 && fixed && largest > 0) mark(touches_fixed_[last]);
  });
}

void ForceGroups::measure(const IncrementalPotential& potential) {
  measure_stencils(potential);
  inertia_.assign(groups(), 0);
  for_each(blocks(), [&](int b) { raise(inertia_[group_of_block_[b]], potential.inertial_force(b)); });
  stencil_.resize(groups());
  contact_root_.resize(groups());
  reference_force_.assign(groups(), 0);
  largest_mass_.assign(groups(), 0);
  supported_.assign(groups(), 0);
  for_each(groups(), [&](int g) {
    const int root = contact_root_[g] = contact_sets_.find(g);
    stencil_[g] = std::max(element_[g], dynamic_[g]);
    raise(reference_force_[root], std::max({load_[g], element_[g], inertia_[g]}));
    raise(largest_mass_[root], mass_[g]);
    if (touches_fixed_[g]) mark(supported_[root]);
  });
  unsupported_ = 0;
  for_each(groups(), [&](int g) {
    if (contact_root_[g] == g && !supported_[g]) mark(unsupported_);
  });
}

}  // namespace tack
