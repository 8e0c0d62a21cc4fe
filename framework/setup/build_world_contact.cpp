// Builds the PairTable from the scene's contact section: contacting objects and their laws.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "framework/body/local_mesh.hpp"
#include "framework/bond/bond_term.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/setup/build_world.hpp"
#include "framework/setup/pair_builder.hpp"
#include "framework/setup/pair_friction.hpp"
#include "framework/scene/rolling_energy.hpp"
#include "framework/setup/refined_surface.hpp"
#include "framework/setup/spins.hpp"
#include "framework/world/hulls.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

// Returns edge areas; rods beside triangles count length times width.
std::vector<double> areas_of_edges(const Mesh& mesh, const Surface& surface, double rod_width) {
  std::vector<double> areas = edge_areas(mesh, surface);
  for (const int e : surface.codim_edges) {
    const auto& [a, b] = surface.edges[e];
    areas[e] = rod_width * (mesh.vertices[a] - mesh.vertices[b]).norm();
  }
  return areas;
}

// Appends a body's surface to the collision mesh.
ContactPrimitives add_surface(const Body& body, int object, const VecX& rest, bool hull, ContactSurface& all) {
  const Mesh mesh = body.surface_triangles.empty() ? local_mesh(body, rest) : surface_mesh(body, rest);
  Surface surface = extract_surface(mesh);
  // Keeps the triangle order of the start of the run, which the history's indices refer to.
  for (size_t t = 0; !body.references.empty() && t < body.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) surface.triangles[t][i] = body.triangles[t][i] - body.first_vertex;
  const auto areas = vertex_areas(mesh, surface);
  all.rod_width.push_back(body.section ? body.section->contact_width() : 0);
  all.particle_radius.push_back(body.radius);
  const auto edges = areas_of_edges(mesh, surface, all.rod_width.back());
  const auto global = [&](int v) {
    return v < body.vertex_count ? body.first_vertex + v : body.surface_vertices[v - body.vertex_count];
  };
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const ContactPrimitives primitives{surface.vertices.empty() ? 0 : area / static_cast<double>(surface.vertices.size()), !surface.triangles.empty(), !surface.codim_edges.empty(), !surface.codim_points.empty()};
  all.mesh.vertex_object.insert(all.mesh.vertex_object.end(), body.vertex_count, object);
  for (const int e : surface.codim_edges)
    all.mesh.codim_edges.push_back(static_cast<int>(all.mesh.edges.size()) + e);
  for (const int v : surface.codim_points) all.mesh.codim_points.push_back(global(v));
  for (const int v : surface.vertices) all.mesh.vertices.push_back(global(v));
  for (const Edge& e : surface.edges) all.mesh.edges.push_back({global(e[0]), global(e[1])});
  for (const Triangle& t : surface.triangles) all.mesh.triangles.push_back({global(t[0]), global(t[1]), global(t[2])});
  all.edge_area.insert(all.edge_area.end(), edges.begin(), edges.end());
  // Closed surfaces: refined surfaces of tetrahedra, hulls, and affine bodies made of triangles.
  const bool closed = hull || !body.frame.empty() || (!body.surface_triangles.empty() && !body.tets.empty());
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t)
    all.two_sided.push_back(!closed && t >= surface.first_sheet);
  return primitives;
}

// Throws InputError if the contact range exceeds the scene's size: all primitives would be in
// contact, most probably through a wrong unit.
void check_range(const PairTable& table, const Value& root, const VecX& rest) {
  double range = 0;
  for (const auto& law : table.laws()) range = std::max(range, law.range());
  const auto points = rest.reshaped(3, rest.size() / 3);
  const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  if (range <= 10 * size) return;
  const Value* contact = root.find("contact");
  throw InputError(fmt::format("{}contact reaches over {:g} m, and the whole scene is {:g} m large; lower contact.distance or "
                               "the range of the adhesion", contact ? contact->mark.text() + ": " : "", range, size));
}

// Throws InputError at a temperature that no energy of the scene reads, and no law.
void refuse_environment(const SceneConfig& scene, const Value& root) {
  if (!scene.environment) return;
  for (const ObjectConfig& object : scene.objects)
    for (const auto& energy : object.energies)
      if (energy->depends_on_temperature()) return;
  const Value* environment = root.find("environment");
  throw InputError((environment ? environment->mark.text() + ": " : "") +
                   "no adhesion law or energy of the scene depends on the temperature, which acts on nothing else; take `environment` away, or choose one that does (`viscoelastic` with `shift`, or an energy that relaxes, as `maxwell`, with `shift`)");
}

// Throws InputError for a rolling object whose friction sticks: anchors follow no rotation of rods
// and particles.
void refuse_rolling_that_sticks(const SceneConfig& scene, const Value& root, const World& world) {
  const PairTable& pairs = world.contact->pairs();
  if (!StickAnchors::any(pairs)) return;
  const auto sticks = [&](int law) { return law >= 0 && pairs.tangential(law).sticks(); };
  for (int a = 0; a < static_cast<int>(world.bodies.size()); ++a) {
    if (!rolls(scene.objects[a])) continue;
    for (int b = 0; b < static_cast<int>(world.bodies.size()); ++b) {
      if (!sticks(pairs.point(a, b).law) && !sticks(pairs.point(b, a).law) && !sticks(pairs.codimensional(a, b).law)) continue;
      const Value* contact = root.find("contact");
      throw InputError(fmt::format("{}'{}' rolls, and its friction with '{}' is `model: stick`, whose anchors follow no rotation of rods and particles; give the two smoothed friction in "
                                   "contact.pairs, or take `rolling` away", contact ? contact->mark.text() + ": " : "", world.bodies[a].name, world.bodies[b].name));
    }
  }
}

// Returns the rigid group of each vertex: prescribed rigid motions and affine bodies; empty without
// either.
std::vector<int> rigid_groups(const World& world) {
  if (world.prescribed_motion.assignments().empty() && world.constraints.frames().empty()) return {};
  std::vector<int> groups;
  for (int v = 0; v < world.dofs.vertex_count(); ++v) groups.push_back(world.prescribed_motion.rigid_group(v));
  int next = static_cast<int>(world.prescribed_motion.assignments().size()) + 1;
  for (const AffineFrame& body : world.constraints.frames()) {
    const bool rigid = std::all_of(body.dependents.begin(), body.dependents.end(),
                                  [&](const AffineFrame::Dependent& c) { return groups[c.vertex] >= 0; });
    ++next;
    for (const AffineFrame::Dependent& c : body.dependents)
      if (!rigid) groups[c.vertex] = next;
  }
  for (const Dependence& d : world.constraints.lasting()) {
    const int group = groups[d.on.front().first];
    const bool one = std::all_of(d.on.begin(), d.on.end(), [&](const auto& on) { return groups[on.first] == group; });
    groups[d.vertex] = one ? group : -1;
  }
  return groups;
}

}  // namespace

void build_contact(const SceneConfig& scene, const Value& root, const RunTimes& times, PhaseClock& clock, World& world) {
  refuse_surface_friction_without_use(scene, root);
  if (!scene.contact) return refuse_environment(scene, root);
  ContactSurface surface;
  std::vector<ContactPrimitives> primitives;
  const std::vector<char> hulls = find_hulls(world);
  for (size_t i = 0; i < world.bodies.size(); ++i)
    primitives.push_back(add_surface(world.bodies[i], static_cast<int>(i), world.rest, hulls[i], surface));
  std::sort(surface.mesh.vertices.begin(), surface.mesh.vertices.end());
  surface.rest = world.rest;
  surface.mesh.vertex_movable.resize(world.rest.size() / 3);
  for (int v = 0; v < world.dofs.vertex_count(); ++v)
    surface.mesh.vertex_movable[v] = world.dofs.moves(v) || world.prescribed_motion.may_move(v);
  surface.mesh.vertex_object.insert(surface.mesh.vertex_object.end(), world.extra_object.begin(), world.extra_object.end());
  surface.mesh.vertex_group = rigid_groups(world);
  std::unique_ptr<ContactPotential> potential = scene.contact->model->make_potential();
  PairBuilder builder(scene, root, std::move(primitives), times, world, *potential);
  builder.build();
  BondTable bonds = std::move(builder.bonds());
  check_range(builder.table(), root, world.rest);
  try {
    world.contact = std::make_unique<ContactSystem>(std::move(surface), std::move(builder.table()),
                                                    builder.colliding(), clock, std::move(potential));
  } catch (const InputError& error) {  // of a surface that the contact model does not take
    const Value* contact = root.find("contact");
    throw InputError((contact ? contact->mark.text() + ": " : "") + error.what());
  }
  if (!std::any_of(bonds.rules().begin(), bonds.rules().end(), [](const BondRule& rule) { return rule.law->depends_on_temperature(); })) refuse_environment(scene, root);
  if (!bonds.empty()) {
    world.bonds = std::make_unique<BondTerm>(*world.contact, std::move(bonds));
    std::vector<std::string> names;
    for (const Body& body : world.bodies) names.push_back(body.name);
    world.bonds->set_environment(scene.environment ? &*scene.environment : nullptr, std::move(names));
  }
  refuse_rolling_that_sticks(scene, root, world);
  if (!world.contact->pairs().any_tangential()) return;
  world.friction = std::make_unique<FrictionTerm>(*world.contact, contact_spins(scene, world));
  std::vector<Vec3> grains;
  for (const ObjectConfig& object : scene.objects) grains.push_back(object.grain.value_or(Vec3::Zero()));
  world.friction->set_grains(std::move(grains));
}

}  // namespace tack
