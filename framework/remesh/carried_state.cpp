#include "framework/remesh/carried_state.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>

#include "framework/core/term_gradient.hpp"
#include "framework/world/energy_records.hpp"
#include "framework/world/remeshed_energy.hpp"
#include "geometry/cross_matrix.hpp"

namespace tack {
namespace {

const NewElements* exchanged_in(int body, const std::vector<NewElements>& exchanged) {
  for (const NewElements& e : exchanged)
    if (e.body == body) return &e;
  return nullptr;
}

// Calls act(vertex now, vertex before, null) for what stays, and act(vertex now, -1, where it was) for what is new. Numbers are those of the worlds.
template <class Act>
void for_each_vertex(const World& was, const World& now, const std::vector<NewElements>& exchanged, const Act& act) {
  for (size_t b = 0; b < was.bodies.size(); ++b) {
    const int first = now.bodies[b].first_vertex, before = was.bodies[b].first_vertex;
    const NewElements* e = exchanged_in(static_cast<int>(b), exchanged);
    for (int v = 0; v < now.bodies[b].vertex_count; ++v) {
      if (!e) act(first + v, before + v, nullptr);
      else if (e->from[v] >= 0) act(first + v, before + e->from[v], nullptr);
      else act(first + v, -1, &e->within[v]);
    }
  }
  const int extra = now.mesh_vertex_count(), extra_before = was.mesh_vertex_count();
  for (int v = extra; v < static_cast<int>(now.rest.size()) / 3; ++v) act(v, extra_before + v - extra, nullptr);
}

struct Momentum {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  // about a point
};

Momentum momentum_of(const World& world, int body, const State& s, const Vec3& about) {
  Momentum p;
  for (const int v : world.vertices_of(body)) {
    const Vec3 mv = world.mass(v) * vertex(s.v, v);
    p.linear += mv;
    p.angular += Vec3(vertex(s.x, v) - about).cross(mv);
  }
  return p;
}

// Gives what is free of the body the rigid motion that makes up for the difference.
void restore_momentum(const World& was, const State& before, const World& now, int body, State& state) {
  const std::vector<char> active = now.prescribed_motion.active(state.time), free = now.prescribed_motion.free(active);
  std::vector<char> chosen = free;
  for (const HeldDirections& held : now.prescribed_motion.fixed_directions(active)) chosen[held.vertex] = 0;
  std::vector<int> vertices;
  double mass = 0;
  Vec3 centre = Vec3::Zero();
  for (const int v : now.vertices_of(body)) {
    if (!chosen[v]) continue;
    vertices.push_back(v);
    mass += now.mass(v);
    centre += now.mass(v) * vertex(state.x, v);
  }
  if (vertices.size() < 4) return;
  centre /= mass;
  const Momentum old = momentum_of(was, body, before, centre), is = momentum_of(now, body, state, centre);
  Mat3 inertia = Mat3::Zero();
  for (const int v : vertices) {
    const Mat3 r = cross_matrix(vertex(state.x, v) - centre);
    inertia -= now.mass(v) * r * r;
  }
  const Vec3 velocity = (old.linear - is.linear) / mass, spin = inertia.ldlt().solve(old.angular - is.angular);
  for (const int v : vertices) vertex(state.v, v) += velocity + spin.cross(Vec3(vertex(state.x, v) - centre));
}

History carried_history(const State& state, const World& was, const World& now, const std::vector<NewElements>& exchanged) {
  std::vector<int> number(static_cast<size_t>(was.rest.size()) / 3, -1);
  for_each_vertex(was, now, exchanged, [&](int v, int before, const Within*) {
    if (before >= 0) number[before] = v;
  });
  History history;
  for (const auto& [name, array] : state.history) {
    if (array.keys.empty()) {
      history[name] = array;
      continue;
    }
    std::vector<std::pair<std::array<int, 2>, int>> entries;
    for (int i = 0; i < array.entries(); ++i)
      if (const int v = number[array.keys[i][0]]; v >= 0) entries.push_back({{v, array.keys[i][1]}, i});
    std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    HistoryArray& carried = history[name] = {array.width, {}, {}};
    for (const auto& [key, i] : entries) {
      carried.keys.push_back(key);
      carried.values.insert(carried.values.end(), array.values.begin() + i * array.width, array.values.begin() + (i + 1) * array.width);
    }
  }
  for (const NewElements& e : exchanged) {
    const std::string& body = was.bodies[e.body].name;
    std::erase_if(history, [&](const auto& entry) { return entry.first.starts_with(body + "/energies/"); });
    for (const ExchangeableTets& tets : was.records.exchangeable())
      if (tets.body == body) history[tets.flow_remembered_as] = {1, e.flow, {}};
  }
  return history;
}

}  // namespace

VecX carried_field(const VecX& field, const World& was, const World& now, const std::vector<NewElements>& exchanged) {
  if (field.size() == 0) return field;
  VecX carried = VecX::Zero(now.rest.size());
  for_each_vertex(was, now, exchanged, [&](int v, int before, const Within* within) {
    if (before >= 0) {
      vertex(carried, v) = vertex(field, before);
      return;
    }
    const int first = was.bodies[now.body_of(v)].first_vertex;
    for (int i = 0; i < 4; ++i) vertex(carried, v) += within->weights[i] * vertex(field, first + within->vertices[i]);
  });
  return carried;
}

State carried_state(const State& state, const World& was, const World& now, const std::vector<NewElements>& exchanged) {
  State carried = state;
  for (VecX State::* field : {&State::x, &State::v, &State::a, &State::anchor, &State::x_before, &State::v_before, &State::contact, &State::contact_before})
    carried.*field = carried_field(state.*field, was, now, exchanged);
  carried.energy.gradient = carried_field(state.energy.gradient, was, now, exchanged);
  for (const NewElements& e : exchanged) {
    const int first = now.bodies[e.body].first_vertex;
    for (size_t v = 0; v < e.places.size(); ++v) vertex(carried.x, first + static_cast<int>(v)) = e.places[v];
    restore_momentum(was, state, now, e.body, carried);
  }
  carried.history = carried_history(state, was, now, exchanged);
  carried.h_before = 0;
  return carried;
}

StoredInObjects stored_in_objects(const World& world, const VecX& x) {
  StoredInObjects stored{0, VecX::Zero(x.size())};
  for (const EnergyRecord& r : world.records.energies())
    if (r.kind == EnergyKind::of_objects) stored.energy += r.value(x);
  for (const auto& term : world.elastic_terms)
    if (term->stores()) add_term_gradient(*term, x, stored.gradient);
  return stored;
}

void book_remeshed_energy(const World& now, const StoredInObjects& before, State& state) {
  EnergyAccount& account = state.energy;
  if (!account.open) return;
  const StoredInObjects stored = stored_in_objects(now, state.x);
  const auto [kinetic, gravity] = energies_of_free_vertices(now, state);
  const double of_vertices = account.kinetic + account.gravity - kinetic - gravity;
  account.kinetic = kinetic;
  account.gravity = gravity;
  account.elastic += of_vertices;  // what is lost is taken off by the step that follows
  if (account.gradient.size() > 0) account.gradient += stored.gradient - before.gradient;
  state.history[RemeshedEnergy::name] = {1, {of_vertices + before.energy - stored.energy}, {}};
}

double lost_by_remeshing(const State& state) {
  const auto found = state.history.find(RemeshedEnergy::name);
  return found == state.history.end() ? 0 : found->second.values.front();
}

}  // namespace tack
