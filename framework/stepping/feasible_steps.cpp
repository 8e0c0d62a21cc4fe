#include "framework/stepping/feasible_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "framework/contact/points/close_pairs.hpp"
#include "framework/core/disjoint_sets.hpp"
#include "framework/stepping/local_potential.hpp"
#include "framework/stepping/obstacle.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Writes the configuration of unknowns q and the displacements of all vertices by p (3n).
void scatter_step(const StepPotential& potential, const VecX& q, const VecX& p, VecX& x, VecX& displacement) {
  x = potential.configuration();
  displacement.setZero(x.size());
  potential.dofs().scatter(q, x);
  potential.dofs().scatter(p, displacement);
}

// Returns the configuration of unknowns q and the displacements of all vertices by p (3n).
std::pair<VecX, VecX> at_vertices(const StepPotential& potential, const VecX& q, const VecX& p) {
  std::pair<VecX, VecX> step;
  scatter_step(potential, q, p, step.first, step.second);
  return step;
}

[[noreturn]] void throw_no_bounds(const StepFilter& filter) {
  throw InputError(fmt::format("the step filter '{}' gives no bounds of single blocks; take another `step` or `type` of the solver, or leave the filter out", filter.type()));
}

}  // namespace

FeasibleSteps::FeasibleSteps(World& world, PhaseClock& clock, IterateCheck* check, const StepFilters& filters)
    : world_(world), clock_(clock), check_(check), filters_(attached_filters({world.contact.get(), world.tets, clock}, filters)) {}

double FeasibleSteps::largest(const VecX& x, const VecX& p) {
  if (check_) check_->check(x);
  double t = 1;
  for (const auto& filter : filters_) {
    clock_.deadline().check();
    t = filter->largest_step(x, p, t);
  }
  clock_.deadline().check();
  return t;
}

double FeasibleSteps::largest_requested(const VecX& x, const VecX& p) {
  x_ = x;
  p_ = p;
  return largest_of_stored();
}

double FeasibleSteps::largest_of_stored() {
  const double feasible = largest(x_, p_);
  if (observer_) observer_(x_, p_, feasible);
  return feasible;
}

double FeasibleSteps::largest_requested(const StepPotential& potential, const VecX& q, const VecX& p) {
  scatter_step(potential, q, p, x_, p_);
  return largest_of_stored();
}

double FeasibleSteps::largest_local(LocalPotential& potential, const VecX& q, const VecX& p) {
  return potential.along(q, p, [&](const VecX& x, const VecX& displacement, std::span<const int> moved) {
    if (check_) check_->check(x);
    double t = 1;
    for (const auto& filter : filters_) {
      clock_.deadline().check();
      const std::optional<double> local = filter->largest_local_step(x, displacement, moved, t);
      t = local ? *local : filter->largest_step(x, displacement, t);
    }
    clock_.deadline().check();
    return t;
  });
}

void FeasibleSteps::set_feasibility(StepPotential& potential, MinimizerProblem& problem) {
  problem.with_neighbours = [&potential](std::span<const int> blocks) { return potential.stencil_maps().with_neighbours(blocks); };
  problem.local = [this, &potential](std::span<const int> blocks) {
    auto objective = std::make_unique<LocalPotential>(potential, world_, clock_, blocks);
    LocalProblem local{nullptr, [this, own = objective.get()](const VecX& q, const VecX& p) { return largest_local(*own, q, p); }, objective->start()};
    local.objective = std::move(objective);
    return local;
  };
  problem.locals = [this, &potential](std::span<const std::vector<int>> sets) {
    const auto motion = std::make_shared<const MotionUnits>(units(potential.dofs()));
    std::vector<LocalProblem> all;
    for (const std::vector<int>& blocks : sets) {
      auto objective = std::make_unique<LocalPotential>(potential, world_, clock_, blocks, true);
      LocalPotential* const own = objective.get();
      LocalProblem& local = all.emplace_back();
      local.feasible_step = [this, own](const VecX& q, const VecX& p) { return largest_local(*own, q, p); };
      local.block_bounds = [this, own, motion](const VecX& q, const VecX& p) { return local_bounds(*own, q, p, *motion); };
      local.resume = [own] { return own->resume(); };
      local.q = objective->start();
      local.objective = std::move(objective);
    }
    return all;
  };
  problem.motion_units = [this, &potential] {
    const MotionUnits motion = units(potential.dofs());
    std::vector<int> of_block;
    for (int b = 0; b < potential.dofs().block_count(); ++b) of_block.push_back(motion.of_vertex[potential.dofs().vertex_of_block(b)]);
    return of_block;
  };
  problem.feasible_step = [&](const VecX& q, const VecX& p) { return largest_requested(potential, q, p); };
  problem.pairs = [&](const VecX& q, double reach) {
    VecX x = potential.configuration();
    potential.dofs().scatter(q, x);
    if (!world_.contact) return std::vector<ClosePair>();
    std::vector<ClosePair> found = close_pairs(*world_.contact, x, reach);
    for (ClosePair& pair : found) pair.bodies = {world_.body_of(pair.vertices[0]), world_.body_of(pair.vertices[pair.first_count])};
    return found;
  };
  problem.cuts = [&](const VecX& q, const VecX& p, double below) { return cuts(potential, q, p, below); };
  problem.block_bounds = [&](const VecX& q, const VecX& p, BlockBound kind) { return block_bounds(potential, q, p, kind); };
}

VecX FeasibleSteps::local_bounds(LocalPotential& potential, const VecX& q, const VecX& p, const MotionUnits& motion) {
  unit_bounds_.resize(motion.count, 1.0);
  const auto refused = potential.along(q, p, [&](const VecX& x, const VecX& displacement, std::span<const int> moved) -> const StepFilter* {
    if (check_) check_->check(x);
    for (const auto& filter : filters_) {
      clock_.deadline().check();
      if (!filter->bound_local_units(x, displacement, moved, motion, unit_bounds_)) return filter.get();
    }
    clock_.deadline().check();
    return nullptr;
  });
  VecX of_blocks(static_cast<Eigen::Index>(potential.vertices_of_blocks().size()));
  for (Eigen::Index b = 0; b < of_blocks.size(); ++b) of_blocks(b) = unit_bounds_[motion.of_vertex[potential.vertices_of_blocks()[b]]];
  for (const int v : potential.vertices_of_blocks()) unit_bounds_[motion.of_vertex[v]] = 1;
  if (refused) throw_no_bounds(*refused);
  return of_blocks;
}

StepCuts FeasibleSteps::cuts(const StepPotential& potential, const VecX& q, const VecX& p, double below) {
  const auto [x, displacement] = at_vertices(potential, q, p);
  StepCuts found;
  for (const auto& filter : filters_) {
    clock_.deadline().check();
    filter->add_cuts(x, displacement, below, found.cuts);
  }
  std::sort(found.cuts.begin(), found.cuts.end());
  const DofMap& dofs = potential.dofs();
  found.block_start.push_back(0);
  for (StepCut& cut : found.cuts) {
    const size_t first = found.blocks.size();
    for (const int v : cut.all_vertices()) {
      if (const int block = dofs.block(v); block >= 0) found.blocks.push_back(block);
      else if (dofs.mixed(v))
        for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) found.blocks.push_back(entry.index);
    }
    const auto own = found.blocks.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(own, found.blocks.end());
    found.blocks.erase(std::unique(own, found.blocks.end()), found.blocks.end());
    found.block_start.push_back(static_cast<int>(found.blocks.size()));
    cut.bodies[0] = world_.body_of(cut.vertices[0]);
    if (cut.first_count < cut.count) cut.bodies[1] = world_.body_of(cut.vertices[cut.first_count]);
  }
  return found;
}

MotionUnits FeasibleSteps::units(const DofMap& dofs) const {
  DisjointSets sets(dofs.block_count());
  const int n = dofs.vertex_count();
  for (const int v : dofs.dependents())
    if (dofs.mixed(v))
      for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) sets.join(entry.index, dofs.blocks(v)[0].index);
  const auto unit = [&](int v) { return dofs.block(v) >= 0 ? sets.find(dofs.block(v)) : dofs.mixed(v) ? sets.find(dofs.blocks(v)[0].index) : -1; };
  for (bool joined = !dofs.plain(); joined;) {
    joined = false;
    for (const Tet& tet : world_.tets) {
      std::array<int, 4> own;
      std::transform(tet.begin(), tet.end(), own.begin(), unit);
      std::sort(own.begin(), own.end());
      const auto first = std::upper_bound(own.begin(), own.end(), -1);
      if (std::adjacent_find(first, own.end()) == own.end()) continue;
      for (auto u = first; u != own.end(); ++u)
        if (*u != *first) sets.join(*u, *first), joined = true;
    }
  }
  MotionUnits units{std::vector<int>(n), dofs.block_count()};
  for (int v = 0; v < n; ++v) units.of_vertex[v] = unit(v);
  return units;
}

VecX FeasibleSteps::block_bounds(const StepPotential& potential, const VecX& q, const VecX& p, BlockBound kind) {
  const auto [x, displacement] = at_vertices(potential, q, p);
  const DofMap& dofs = potential.dofs();
  const MotionUnits motion = units(dofs);
  std::vector<double> bounds(motion.count, 1.0);
  for (const auto& filter : filters_) {
    clock_.deadline().check();
    if (!filter->bound_units(x, displacement, motion, kind, bounds)) throw_no_bounds(*filter);
  }
  VecX of_blocks(dofs.block_count());
  for (int b = 0; b < dofs.block_count(); ++b) of_blocks(b) = bounds[motion.of_vertex[dofs.vertex_of_block(b)]];
  return of_blocks;
}

std::string FeasibleSteps::blocker() const {
  if (x_.size() == 0) return "";
  const std::string description = describe_blocker(world_, filters_, x_, p_);
  return description.empty() ? "" : "; the last step was " + description;
}

}  // namespace tack
