#include "framework/remesh/state_transfer.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>

#include "framework/contact/points/stick_anchors.hpp"
#include "framework/core/term_gradient.hpp"
#include "framework/world/energy_records.hpp"
#include "framework/world/remeshed_energy.hpp"
#include "geometry/cross_matrix.hpp"

namespace tack {
namespace {

const NewElements* new_elements_of(int body, const std::vector<NewElements>& exchanged) {
  for (const NewElements& e : exchanged)
    if (e.body == body) return &e;
  return nullptr;
}

// Calls act(new index, old index, null) for each vertex that stays, and act(new index, -1, point in the old mesh) for each new
// vertex. Indices are those of the worlds.
template <class Act>
void for_each_vertex(const World& old_world, const World& new_world, const std::vector<NewElements>& exchanged, const Act& act) {
  for (size_t b = 0; b < old_world.bodies.size(); ++b) {
    const int first = new_world.bodies[b].first_vertex, before = old_world.bodies[b].first_vertex;
    const NewElements* e = new_elements_of(static_cast<int>(b), exchanged);
    for (int v = 0; v < new_world.bodies[b].vertex_count; ++v) {
      if (!e) act(first + v, before + v, nullptr);
      else if (e->from[v] >= 0) act(first + v, before + e->from[v], nullptr);
      else act(first + v, -1, &e->within[v]);
    }
  }
  const int extra = new_world.mesh_vertex_count(), extra_before = old_world.mesh_vertex_count();
  for (int v = extra; v < static_cast<int>(new_world.rest.size()) / 3; ++v) act(v, extra_before + v - extra, nullptr);
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

// Adds a rigid velocity to the body's free vertices, so that its momentum is that of the old state.
void restore_momentum(const World& old_world, const State& before, const World& new_world, int body, State& state) {
  const std::vector<char> active = new_world.prescribed_motion.active(state.time), free = new_world.prescribed_motion.free(active);
  std::vector<char> moving = free;
  for (const FixedDirections& held : new_world.prescribed_motion.fixed_directions(active)) moving[held.vertex] = 0;
  std::vector<int> vertices;
  double mass = 0;
  Vec3 centre = Vec3::Zero();
  for (const int v : new_world.vertices_of(body)) {
    if (!moving[v]) continue;
    vertices.push_back(v);
    mass += new_world.mass(v);
    centre += new_world.mass(v) * vertex(state.x, v);
  }
  if (vertices.size() < 4) return;
  centre /= mass;
  const Momentum target = momentum_of(old_world, body, before, centre), current = momentum_of(new_world, body, state, centre);
  Mat3 inertia = Mat3::Zero();
  for (const int v : vertices) {
    const Mat3 r = cross_matrix(vertex(state.x, v) - centre);
    inertia -= new_world.mass(v) * r * r;
  }
  const Vec3 velocity = (target.linear - current.linear) / mass, spin = inertia.ldlt().solve(target.angular - current.angular);
  for (const int v : vertices) vertex(state.v, v) += velocity + spin.cross(Vec3(vertex(state.x, v) - centre));
}

History transfer_history(const State& state, const World& old_world, const World& new_world, const std::vector<NewElements>& exchanged) {
  std::vector<int> number(static_cast<size_t>(old_world.rest.size()) / 3, -1);
  for_each_vertex(old_world, new_world, exchanged, [&](int v, int before, const TetPoint*) {
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
    HistoryArray& result = history[name] = {array.width, {}, {}};
    for (const auto& [key, i] : entries) {
      result.keys.push_back(key);
      result.values.insert(result.values.end(), array.values.begin() + i * array.width, array.values.begin() + (i + 1) * array.width);
    }
  }
  history.erase(StickAnchors::history_name);  // holds indices of vertices: contacts find new anchors
  for (const NewElements& e : exchanged) {
    const std::string& body = old_world.bodies[e.body].name;
    std::erase_if(history, [&](const auto& entry) { return entry.first.starts_with(body + "/energies/"); });
    for (const ExchangeableTets& tets : old_world.records.exchangeable())
      if (tets.body == body) history[tets.plastic_strain_history] = {1, e.flow, {}};
  }
  return history;
}

}  // namespace

VecX transfer_field(const VecX& field, const World& old_world, const World& new_world, const std::vector<NewElements>& exchanged) {
  if (field.size() == 0) return field;
  VecX result = VecX::Zero(new_world.rest.size());
  for_each_vertex(old_world, new_world, exchanged, [&](int v, int before, const TetPoint* within) {
    if (before >= 0) {
      vertex(result, v) = vertex(field, before);
      return;
    }
    const int first = old_world.bodies[new_world.body_of(v)].first_vertex;
    for (int i = 0; i < 4; ++i) vertex(result, v) += within->weights[i] * vertex(field, first + within->vertices[i]);
  });
  return result;
}

State transfer_state(const State& state, const World& old_world, const World& new_world, const std::vector<NewElements>& exchanged) {
  State result = state;
  for (VecX State::* field : {&State::x, &State::v, &State::a, &State::x_motion_start, &State::x_before, &State::v_before, &State::contact, &State::contact_before})
    result.*field = transfer_field(state.*field, old_world, new_world, exchanged);
  result.energy.gradient = transfer_field(state.energy.gradient, old_world, new_world, exchanged);
  for (const NewElements& e : exchanged) {
    const int first = new_world.bodies[e.body].first_vertex;
    for (size_t v = 0; v < e.positions.size(); ++v) vertex(result.x, first + static_cast<int>(v)) = e.positions[v];
    restore_momentum(old_world, state, new_world, e.body, result);
  }
  result.history = transfer_history(state, old_world, new_world, exchanged);
  result.h_before = 0;
  return result;
}

StoredEnergy stored_energy_of_objects(const World& world, const VecX& x) {
  StoredEnergy stored{0, VecX::Zero(x.size())};
  for (const EnergyRecord& r : world.records.energies())
    if (r.kind == EnergyKind::of_objects) stored.energy += r.value(x);
  for (const auto& term : world.elastic_terms)
    if (term->stores()) add_term_gradient(*term, x, stored.gradient);
  return stored;
}

void record_energy_loss(const World& new_world, const StoredEnergy& before, State& state) {
  EnergyAccount& account = state.energy;
  if (!account.open) return;
  const StoredEnergy stored = stored_energy_of_objects(new_world, state.x);
  const auto [kinetic, gravity] = energies_of_free_vertices(new_world, state);
  const double of_vertices = account.kinetic + account.gravity - kinetic - gravity;
  account.kinetic = kinetic;
  account.gravity = gravity;
  account.elastic += of_vertices;  // the next step subtracts the loss
  if (account.gradient.size() > 0) account.gradient += stored.gradient - before.gradient;
  state.history[RemeshedEnergy::name] = {1, {of_vertices + before.energy - stored.energy}, {}};
}

double energy_loss_of_remeshing(const State& state) {
  const auto found = state.history.find(RemeshedEnergy::name);
  return found == state.history.end() ? 0 : found->second.values.front();
}

}  // namespace tack
