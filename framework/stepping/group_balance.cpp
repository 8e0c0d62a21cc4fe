#include "framework/stepping/group_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "framework/core/disjoint_sets.hpp"
#include "framework/load/following_load.hpp"

namespace tack {
namespace {

// Sets of vertices that belong to one account.
class VertexSets {
 public:
  VertexSets(const World& world, const VecX& x) : world_(world), x_(x), sets_(static_cast<int>(x.size()) / 3) {
    for (size_t i = 0; i < world.bodies.size(); ++i) join(world.vertices_of(static_cast<int>(i)));
    for (const std::vector<int>& group : world.meeting.bodies)
      for (const int body : group) join_bodies(group.front(), body);
    for (const auto& [pusher, body] : world.meeting.pushed) join_bodies(pusher, body);
    for (const auto& [a, b] : world.attached)
      if (is_moved(a) && is_moved(b)) join_bodies(a, b);
    for (const EnergyRecord& record : world.records.energies()) {
      if (record.kind == EnergyKind::of_step || record.kind == EnergyKind::weight) continue;
      if (!record.term || world.records.replaced(*record.term)) join_all();
      else if (!record.term->visit_energies(x, [](std::span<const int>, double) {})) join_stencils(*record.term);
    }
    for (const FlowRecord& record : world.records.flows()) {
      const auto& columns = record.columns;
      if (record.visit_energies || std::all_of(columns.begin(), columns.end(), [](const FlowColumn& c) { return c.kind == FlowKind::within; })) continue;
      if (record.term) join_stencils(*record.term);
      else join_all();
    }
    for (const FollowingLoad* load : world.following_loads)
      if (!load->stores()) join_stencils(*load);
  }

  int find(int v) { return sets_.find(v); }

 private:
  bool is_moved(int body) const {
    return world_.bodies[body].movable || std::any_of(world_.meeting.pushed.begin(), world_.meeting.pushed.end(), [&](const auto& p) { return p.first == body; });
  }
  template <class Vertices>
  void join(const Vertices& vertices) {
    for (const int v : vertices) sets_.join(v, *std::begin(vertices));
  }
  void join_bodies(int a, int b) { sets_.join(world_.bodies[a].first_vertex, world_.bodies[b].first_vertex); }
  void join_all() {
    for (int v = 1; v < x_.size() / 3; ++v) sets_.join(0, v);
  }
  // Joins the vertices of the stencils of a term. A term without batches may act on all vertices. Fixed
  // bodies without motion join no sets.
  void join_stencils(const Term& term) {
    int first = -1;
    const std::vector<StencilBatch> batches = term.batches();
    if (std::all_of(batches.begin(), batches.end(), [](const StencilBatch& b) { return b.count == 0; })) {
      if (batches.empty()) join_all();
      return;
    }
    for (const StencilBatch& batch : batches)
      for (size_t i = 0; i < static_cast<size_t>(batch.arity) * batch.count; ++i) {
        const int v = batch.vertices[i], body = world_.body_of(v);
        if (body >= 0 && !is_moved(body)) continue;
        if (first < 0) first = v;
        sets_.join(first, v);
      }
  }

  const World& world_;
  const VecX& x_;
  DisjointSets sets_;
};

}  // namespace

std::array<double, 2> ballistic_energies(const World& world, int body, const State& state, double h, double tolerance) {
  double mass = 0;
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();
  bool free = world.bodies[body].movable;
  for (const int v : world.vertices_of(body)) {
    if (world.mass(v) == 0 || world.is_scalar_dof(v)) continue;
    free = free && world.dofs.moves(v);
    mass += world.mass(v);
    before += world.mass(v) * vertex(state.v_before, v);
    after += world.mass(v) * vertex(state.v, v);
  }
  if (!free || mass == 0 || (after - before - mass * h * world.gravity).norm() > mass * tolerance) return {};
  return {before.squaredNorm() / (2 * mass), after.squaredNorm() / (2 * mass)};
}

// Finds the groups. Vertices of other bodies, and of interactions with other bodies only, have group
// -1.
void GroupBalance::find(const VecX& x) {
  found_ = true;
  if (world_.meeting.bodies.size() < 2) return;
  VertexSets sets(world_, x);
  std::vector<int> number(x.size() / 3, -1);
  for (const std::vector<int>& group : world_.meeting.bodies) {
    int& of_root = number[sets.find(world_.bodies[group.front()].first_vertex)];
    if (of_root < 0) {
      of_root = static_cast<int>(names_.size());
      names_.emplace_back();
    }
  }
  if (names_.size() < 2) return names_.clear();
  group_.resize(number.size());
  for (size_t v = 0; v < number.size(); ++v) group_[v] = number[sets.find(static_cast<int>(v))];
  std::vector<int> first(names_.size(), -1), count(names_.size(), 0);
  for (size_t i = 0; i < world_.bodies.size(); ++i) {
    const Body& body = world_.bodies[i];
    const int group = group_[body.first_vertex];
    if (group < 0 || !body.movable) continue;
    if (count[group]++ == 0) first[group] = static_cast<int>(i);
  }
  for (size_t g = 0; g < names_.size(); ++g)
    names_[g] = fmt::format("'{}'", world_.bodies[first[g]].name) + (count[g] > 1 ? fmt::format(" and {} more", count[g] - 1) : "");
}

// Returns the first group among the vertices; -1: none. Marks both groups if there is a second one.
int GroupBalance::group_of(std::span<const int> vertices) const {
  int found = -1;
  for (const int v : vertices) {
    const int group = group_[v];
    if (group < 0 || group == found) continue;
    if (found >= 0) met_another_[group] = met_another_[found] = 1;
    else found = group;
  }
  return found;
}

void GroupBalance::add_stored(const VecX& x, std::vector<GroupAccount>& accounts) const {
  std::vector<const Term*> done;
  for (const EnergyRecord& record : world_.records.energies()) {
    if (record.kind == EnergyKind::of_step || record.kind == EnergyKind::weight) continue;
    if (std::find(done.begin(), done.end(), record.term) != done.end()) continue;
    done.push_back(record.term);
    double GroupAccount::*const kind = record.kind == EnergyKind::contact ? &GroupAccount::contact : &GroupAccount::elastic;
    const bool shared = record.term->visit_energies(x, [&](std::span<const int> vertices, double joules) {
      if (const int g = group_of(vertices); g >= 0) accounts[g].*kind += joules;
    });
    if (shared) continue;
    for (const StencilBatch& batch : record.term->batches())
      if (const int g = batch.count > 0 ? group_of({batch.vertices, static_cast<size_t>(batch.arity) * batch.count}) : -1; g >= 0) {
        accounts[g].*kind += record.term->value(x);
        break;
      }
  }
}

std::vector<GroupAccount> GroupBalance::accounts_at(const State& state) const {
  std::vector<GroupAccount> accounts(names_.size());
  for (int v = 0; v < world_.dofs.vertex_count(); ++v) {
    const int g = group_[v];
    if (g < 0 || !world_.dofs.moves(v)) continue;
    accounts[g].kinetic += 0.5 * world_.mass(v) * vertex(state.v, v).squaredNorm();
    accounts[g].gravity += world_.gravitational_mass(v) * world_.gravity.dot(vertex(world_.rest, v) - vertex(state.x, v));
  }
  return accounts;
}

bool GroupBalance::needs_contact(const State& state) const {
  return found_ ? state.energy.groups.size() != names_.size() : world_.meeting.bodies.size() > 1;
}

void GroupBalance::begin(const State& state) {
  if (!found_) find(state.x);
  if (names_.empty()) return;
  step_.assign(names_.size(), {});
  met_another_.assign(names_.size(), 0);
  start_ = accounts_at(state);
  if (state.energy.groups.size() != names_.size()) {
    add_stored(state.x, start_);
    return;
  }
  for (size_t g = 0; g < start_.size(); ++g) {
    const GroupAccount now = start_[g];
    start_[g] = state.energy.groups[g];
    start_[g].kinetic = now.kinetic;
    start_[g].gravity = now.gravity;
  }
}

void GroupBalance::end(const VecX& x) {
  if (names_.empty()) return;
  for (Step& step : step_) step.dissipated = 0;
  for (const FlowRecord& record : world_.records.flows()) {
    if (record.visit_energies) {
      record.visit_energies(x, [&](std::span<const int> vertices, double joules) {
        if (const int g = group_of(vertices); g >= 0) step_[g].dissipated += joules;
      });
    } else if (record.term) {
      std::vector<double> amounts(record.columns.size());
      record.amounts(x, amounts.data());
      const auto batches = record.term->batches();
      const auto some = std::find_if(batches.begin(), batches.end(), [](const StencilBatch& b) { return b.count > 0; });
      const int g = some == batches.end() ? -1 : group_of({some->vertices, static_cast<size_t>(some->arity) * some->count});
      for (size_t i = 0; i < amounts.size() && g >= 0; ++i)
        step_[g].dissipated += record.columns[i].kind == FlowKind::dissipated ? amounts[i] : record.columns[i].kind == FlowKind::fed ? -amounts[i] : 0;
    }
  }
  for (const auto* load : world_.following_loads) {
    if (load->stores()) continue;
    for (const StencilBatch& batch : load->batches())
      if (const int g = batch.count > 0 ? group_of({batch.vertices, static_cast<size_t>(batch.arity) * batch.count}) : -1; g >= 0) {
        step_[g].work += load->work(x, world_.dofs);
        break;
      }
  }
}

void GroupBalance::add_load_work(int vertex, double work) {
  if (!names_.empty() && group_[vertex] >= 0) step_[group_[vertex]].work += work;
}

void GroupBalance::add_prescribed_work(int vertex, double work, double at_end) {
  if (names_.empty() || group_[vertex] < 0) return;
  step_[group_[vertex]].prescribed += work;
  step_[group_[vertex]].prescribed_at_end += at_end;
}

std::vector<GroupFlow> GroupBalance::close(State& state, double h) {
  std::vector<GroupFlow> flows(names_.size());
  if (names_.empty()) return flows;
  std::vector<GroupAccount> end = accounts_at(state);
  add_stored(state.x, end);
  std::vector<std::array<double, 2>> ballistic(names_.size());
  std::vector<double> mass(names_.size(), 0);
  for (size_t i = 0; i < world_.bodies.size(); ++i) {
    const int g = group_[world_.bodies[i].first_vertex];
    if (g < 0 || state.v_before.size() != state.v.size()) continue;
    const auto [before, after] = ballistic_energies(world_, static_cast<int>(i), state, h, tolerance_);
    ballistic[g][0] += before;
    ballistic[g][1] += after;
  }
  for (int v = 0; v < world_.dofs.vertex_count(); ++v)
    if (group_[v] >= 0) mass[group_[v]] += world_.mass(v);
  const auto stored = [](const GroupAccount& a) { return a.kinetic + a.gravity + a.elastic + a.contact; };
  for (size_t g = 0; g < end.size(); ++g) {
    const GroupAccount& start = start_[g];
    const Step& step = step_[g];
    GroupAccount& now = end[g];
    GroupFlow& flow = flows[g];
    flow.numerics = stored(start) + step.work + step.prescribed - step.dissipated - stored(now);
    flow.jerk = std::max(0.0, step.prescribed_at_end - step.prescribed);
    flow.noise = mass[g] * tolerance_ * tolerance_;
    flow.in_contact = start.contact != 0 || now.contact != 0;
    now.met_another = flow.met_another = start.met_another || met_another_[g];
    now.dissipated = start.dissipated + std::max(0.0, step.dissipated);
    now.reference_energy = start.reference_energy;
    now.reference_energy.kinetic = std::max({now.reference_energy.kinetic, start.kinetic, now.kinetic});
    now.reference_energy.dissipated = now.dissipated;
    ReferenceEnergy::move(now.reference_energy.elastic, now.elastic - start.elastic);
    ReferenceEnergy::move(now.reference_energy.contact, now.contact - start.contact);
    ReferenceEnergy::move(now.reference_energy.gravity, now.gravity - start.gravity);
    ReferenceEnergy::move(now.reference_energy.work, step.work + step.prescribed);
    flow.moving = std::max(start.kinetic - ballistic[g][0], now.kinetic - ballistic[g][1]);
    ReferenceEnergy concerned = now.reference_energy;
    concerned.kinetic = flow.moving;
    flow.reference_energy = concerned.largest();
  }
  state.energy.groups = std::move(end);
  return flows;
}

}  // namespace tack
