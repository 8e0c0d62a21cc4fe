#include "framework/world/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "framework/bond/bond_term.hpp"
#include "framework/config/nearest.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/core/damping_terms.hpp"
#include "framework/load/following_load.hpp"
#include "framework/world/remeshed_energy.hpp"
#include "geometry/errors.hpp"

namespace tack {

World::World() = default;
World::~World() = default;

std::vector<Term*> World::contact_terms() const {
  std::vector<Term*> all;
  if (contact)
    for (const auto& term : contact->potential().terms()) all.push_back(term.get());
  if (bonds) all.push_back(bonds.get());
  if (friction) all.push_back(friction.get());
  return all;
}

int World::body_index(const std::string& name) const {
  for (size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].name == name) return static_cast<int>(i);
  return -1;
}

int World::index_of(const std::string& name, const std::string& who) const {
  if (const int index = body_index(name); index >= 0) return index;
  std::vector<std::string> names;
  for (const Body& body : bodies) names.push_back(body.name);
  throw InputError(fmt::format("{}no object is named '{}'{}", who, name, suggestion(name, names, "objects")));
}

int World::body_of(int vertex) const {
  if (vertex >= mesh_vertex_count()) return extra_object[vertex - mesh_vertex_count()];
  const auto after = std::upper_bound(bodies.begin(), bodies.end(), vertex, [](int v, const Body& body) { return v < body.first_vertex; });
  return static_cast<int>(after - bodies.begin()) - 1;
}

std::vector<int> World::vertices_of(int body) const {
  std::vector<int> all(bodies[body].vertex_count);
  std::iota(all.begin(), all.end(), bodies[body].first_vertex);
  all.insert(all.end(), bodies[body].extra_vertices.begin(), bodies[body].extra_vertices.end());
  return all;
}

int World::index_in_body(int vertex) const {
  const Body& body = bodies[body_of(vertex)];
  if (vertex < mesh_vertex_count()) return vertex - body.first_vertex;
  const auto at = std::lower_bound(body.extra_vertices.begin(), body.extra_vertices.end(), vertex);
  return body.vertex_count + static_cast<int>(at - body.extra_vertices.begin());
}

bool World::is_scalar_dof(int vertex) const {
  const auto after = std::upper_bound(unknowns.begin(), unknowns.end(), vertex, [](int v, const UnknownGroup& group) { return v < group.vertices.front(); });
  return vertex >= mesh_vertex_count() && after != unknowns.begin() && std::prev(after)->length > 0;
}

void World::collect_on_meshes(VecX& forces) const {
  for (const Dependence& d : constraints.lasting()) {
    for (const auto& [on, weight] : d.on) vertex(forces, on) += weight * vertex(forces, d.vertex);
    vertex(forces, d.vertex).setZero();
  }
}

Vec3 World::centre_of_mass(int body, const VecX& x) const {
  const Body& b = bodies[body];
  Vec3 sum = Vec3::Zero();
  double total = 0;
  const auto add = [&](int v) {
    const double m = mass(v) > 0 ? mass(v) : 1.0;  // fixed objects have no mass
    sum += m * vertex(x, v);
    total += m;
  };
  if (b.frame.empty() || mass(b.frame[0]) == 0) {
    for (int v = b.first_vertex; v < b.first_vertex + b.vertex_count; ++v) add(v);
  } else {
    for (const int v : b.frame) add(v);
  }
  return sum / total;
}

}  // namespace tack
