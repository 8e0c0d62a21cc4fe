#include "framework/setup/build_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/body/selected_elements.hpp"
#include "framework/config/bind.hpp"
#include "framework/bond/bond_term.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/core/damping_terms.hpp"
#include "framework/load/following_load.hpp"
#include "framework/rod/rod_frames.hpp"
#include "framework/scene/energy_with_unknowns.hpp"
#include "framework/setup/add_loads.hpp"
#include "framework/setup/adjust_overclosures.hpp"
#include "framework/setup/affine_bodies.hpp"
#include "framework/setup/contact_support.hpp"
#include "framework/setup/initial_state.hpp"
#include "framework/setup/interaction_builder.hpp"
#include "framework/setup/named_selections.hpp"
#include "framework/setup/refined_surface.hpp"
#include "framework/setup/relative_motion.hpp"
#include "framework/setup/remesh_checks.hpp"
#include "framework/setup/rod_twists.hpp"
#include "framework/setup/spins.hpp"
#include "framework/setup/start_checks.hpp"
#include "framework/shapes/mesh_cache.hpp"
#include "framework/world/consistent_mass.hpp"
#include "framework/world/driven_adhesion.hpp"
#include "framework/world/energy_records.hpp"
#include "framework/world/remeshed_energy.hpp"
#include "geometry/errors.hpp"
#include "geometry/exact/orientation.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/mesh/validate.hpp"
#include "geometry/tets/divide_tets.hpp"

namespace tack {
namespace {

Mesh placed_mesh(Mesh mesh, const ObjectConfig& object) {
  object.placement.apply(mesh);
  validate_mesh(mesh, fmt::format("object '{}'", object.name));
  return mesh;
}

// Returns the mesh with the object's kind of elements, and records the kind in the digest of the mesh
// before placement.
Mesh with_elements(Mesh mesh, const ObjectConfig& object, MeshDigest& digest) {
  if (object.elements == Elements::linear) return mesh;
  const char* remedy = "take `elements` away";
  if (mesh.tets.empty())
    throw InputError(fmt::format("object '{}' has no tets of which `elements` could be; {}, or use a tet mesh or shape", object.name, remedy));
  if (object.body)
    throw InputError(fmt::format("object '{}' is an affine body, which does not strain: `elements` would do nothing; {}", object.name, remedy));
  for (const auto& energy : object.energies)
    if (energy->poisson() && !energy->takes_elements())
      throw InputError(fmt::format("object '{}': the energy {} knows linear tets only (its material has no volume of its own, "
                                   "energies/solid/material_split.hpp); {}", object.name, energy->type(), remedy));
  if (object.elements != Elements::composite) return mesh;
  mesh = divide_tets(mesh);
  const MeshDigest divided = digest_of(mesh);
  digest.vertex_count = divided.vertex_count;
  digest.element_count = divided.element_count;
  digest.elements = divided.elements;
  return mesh;
}

// Returns the mesh of a remeshed object, with the scene's groups selected again.
Mesh mesh_of(const FlowedMesh& remeshed, const ObjectConfig& object, const SceneConfig& scene) {
  Mesh mesh = remeshed.mesh;
  for (const auto* names : {&object.selections, &scene.selections})
    for (const NamedSelection& named : *names) mesh.tags.erase(named.name);
  return mesh;
}

// Appends a mesh to the world as a body.
void add_body(const ObjectConfig& object, const Mesh& mesh, const FlowedMesh* remeshed, World& world) {
  Body body;
  body.name = object.name;
  body.first_vertex = static_cast<int>(world.rest.size()) / 3;
  body.vertex_count = static_cast<int>(mesh.vertices.size());
  world.rest.conservativeResize(world.rest.size() + 3 * body.vertex_count);
  for (int i = 0; i < body.vertex_count; ++i)
    vertex(world.rest, body.first_vertex + i) = mesh.vertices[i];
  const auto shifted = [&](auto elements) {
    for (auto& element : elements)
      for (int& v : element) v += body.first_vertex;
    return elements;
  };
  body.tags = mesh.tags;
  body.tets = shifted(mesh.tets);
  body.elements = object.elements;
  const Surface surface = extract_surface(mesh);
  body.triangles = shifted(remeshed ? remeshed->surface : surface.triangles);
  body.flows = object.remesh.has_value();
  if (remeshed) body.references = remeshed->references;
  body.sheet.assign(body.triangles.begin() + surface.first_sheet, body.triangles.end());
  if (object.shell) {
    if (body.sheet.empty())
      throw InputError(fmt::format("object '{}' is given a thickness (shell), and its mesh has no triangles but faces of tets; "
                                   "take it away, or use a shape of triangles", object.name));
    body.thickness = object.shell->thickness;
  }
  body.edges = shifted(mesh.edges);
  for (const int v : mesh.points) body.points.push_back(body.first_vertex + v);
  if (object.rod) {
    if (body.edges.empty())
      throw InputError(fmt::format("object '{}' has a section (rod) and no explicit edges; take `rod` away, or choose a shape of "
                                   "edges", object.name));
    body.section = object.rod->section();
  }
  if (object.particle) {
    if (body.points.empty())
      throw InputError(fmt::format("object '{}' has a radius (particle) and no explicit points; take `particle` away, or choose a "
                                   "shape of points", object.name));
    body.radius = object.particle->radius;
  }
  world.bodies.push_back(std::move(body));
}

void prescribe_motions(const SceneConfig& scene, int index, World& world) {
  const ObjectConfig& object = scene.objects[index];
  for (size_t i = 0; i < object.motion.size(); ++i) {
    const std::string name = fmt::format("motion {} ({}) of '{}'", i, object.motion[i]->type(), object.name);
    auto relative = relative_motion(*object.motion[i], name, object.name, scene);
    if (!object.motion[i]->drive().empty()) {
      if (relative) throw InputError(fmt::format("{}: follows the drive '{}', and cannot have a carrier; take one of the two away", name, object.motion[i]->drive()));
      relative = instance_of(*object.motion[i]);
      relative->follow(world.drives.follow(relative->drive(), relative->drive_kind(), name));
    }
    const Motion& motion = relative ? *relative : *object.motion[i];
    std::vector<int> vertices = select(object.motion[i]->selection(), world.selection_context(index));
    if (object.remesh) drop_interior_vertices(name, world.bodies[index], vertices);
    if (motion.partial() && object.body) {
      if (static_cast<int>(vertices.size()) != world.bodies[index].vertex_count)
        throw InputError(fmt::format("{}: fixes directions of some vertices of an affine body; select all of it, or fix "
                                     "vertices in all directions (on a line: a hinge, one: a joint)", name));
      vertices = world.bodies[index].frame;
    }
    world.prescribed_motion.add({&motion, vertices, name});
    prescribe_twists(motion, vertices, name, index, world);
    fix_spins(motion, vertices, name, index, world);
    if (relative) world.own_motions.push_back(std::move(relative));
  }
  Body& body = world.bodies[index];
  body.movable = false;
  if (body.rod)
    for (const int v : body.rod->twists()) body.movable = body.movable || world.prescribed_motion.ever_free(v);
  for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v)
    body.movable = body.movable || world.prescribed_motion.ever_free(v);
}

Unknowns unknowns_of(int index, World& world) {
  return Unknowns(world, fmt::format("{}/{}", world.bodies[index].name, world.bodies[index].energy), index);
}

void add_energies(const ObjectConfig& object, int index, World& world) {
  Body& body = world.bodies[index];
  if (!body.movable) return;
  const bool mass_damping = object.damping && object.damping->mass > 0;
  if (object.body) {
    add_affine_masses(object, index, world);
    if (mass_damping)
      world.damping_terms.push_back(std::make_unique<MassDamping>(body.frame[0], 4, world.mass, object.damping->mass));
    if (object.damping && object.damping->stiffness > 0)
      throw InputError(fmt::format("object '{}' is an affine body, which does not strain: damping.stiffness would do nothing; "
                                   "take it away, or give damping.mass", object.name));
    return;
  }
  if (object.energies.empty())
    throw InputError(fmt::format("object '{}' can move but has no energies; give it a material "
                                 "(energies: [...]), make it an affine body (body: affine) or fix it (motion: [fixed])", object.name));
  for (const auto& energy : object.energies) {
    std::optional<Body> selected;
    if (energy->selection()) selected = selected_elements(*energy->selection(), {body, world.rest});
    const Body& selected_body = selected ? *selected : body;
    const auto* with_unknowns = dynamic_cast<const EnergyWithUnknowns*>(energy.get());
    std::unique_ptr<Term> term = with_unknowns ? with_unknowns->make_with_unknowns(selected_body, world.rest, unknowns_of(index, world)) : energy->make_term(selected_body, world.rest);
    energy->add_mass(selected_body, world.rest, world.mass);
    ++body.energy;
    if (!term) continue;
    if (object.damping && object.damping->stiffness > 0)
      world.damping_terms.push_back(stiffness_damping(*term, object.damping->stiffness));
    world.elastic_terms.push_back(std::move(term));
  }
  add_spin_masses(index, world);
  if (mass_damping) {
    world.damping_terms.push_back(std::make_unique<MassDamping>(body.first_vertex, body.vertex_count, world.mass, object.damping->mass));
    for (const UnknownGroup& group : world.unknowns)
      if (group.body == index && world.mass(group.vertices.front()) > 0)
        world.damping_terms.push_back(std::make_unique<MassDamping>(group.vertices.front(), static_cast<int>(group.vertices.size()), world.mass, object.damping->mass));
  }
  world.tets.insert(world.tets.end(), body.tets.begin(), body.tets.end());
}

void check_mass(const Value& root, const World& world) {
  for (int v = 0; v < world.mesh_vertex_count(); ++v) {
    if (world.mass(v) > 0 || !world.prescribed_motion.ever_free(v)) continue;
    const int i = world.body_of(v);
    if (world.bodies[i].frame.empty())
      throw InputError(fmt::format("{}object '{}': vertex {} has no mass; give every part an energy "
                                   "with a density", source_location(root, "objects", static_cast<size_t>(i)), world.bodies[i].name,
                                   world.index_in_body(v)));
  }
}

void start_state(const SceneConfig& scene, World& world) {
  State& s = world.start;
  s.x = world.rest;
  world.dofs.update_dependents(s.x);
  s.v = s.a = VecX::Zero(world.rest.size());
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const ObjectConfig& object = scene.objects[i];
    if (object.velocity.isZero() && object.spin.isZero()) continue;
    const Vec3 centre = object.spin.isZero() ? Vec3::Zero() : world.centre_of_mass(static_cast<int>(i), s.x);
    const Body& body = world.bodies[i];
    if (body.rod)
      for (int e = 0; e < body.rod->count(); ++e)
        if (const int v = body.rod->twists()[e]; world.dofs.moves(v)) s.v(3 * v) = body.rod->radius() * object.spin.dot(body.rod->tangent(e, s.x));
    set_spin_velocities(object.spin, static_cast<int>(i), world, s.v);
    for (const int v : world.vertices_of(static_cast<int>(i))) {
      if (world.is_scalar_dof(v)) continue;
      if (world.dofs.moves(v)) vertex(s.v, v) = object.velocity + object.spin.cross(Vec3(vertex(s.x, v) - centre));
    }
  }
  if (!world.constraints.joints().empty()) project_velocities(world.dofs, world.mass, s.v);
  world.dofs.update_dependents(s.v);
}

// Calls action for each object and adds its source location to messages.
template <class Action>
void for_each_object(const SceneConfig& scene, const Value& root, const Action& action) {
  for (size_t i = 0; i < scene.objects.size(); ++i)
    with_source_location(entry_of(root.find("objects"), i), [&] { action(i); });
}

// Returns the record of a scene with friction of mu = 0: its forces are zero.
ForceRecord zero_friction_record() {
  ForceRecord force{"friction", ForceDirection::tangential, {"friction", "adhesion"}};
  force.add = [](const VecX&, std::string_view, VecX&) {};
  force.between = [](const VecX&, std::string_view, ObjectPair) { return Vec3(Vec3::Zero()); };
  force.stored = false;
  return force;
}

bool has_friction(const SceneConfig& scene) {
  if (!scene.contact) return false;
  const auto& pairs = scene.contact->pairs;
  if (std::any_of(scene.objects.begin(), scene.objects.end(), [](const auto& object) { return object.friction.has_value(); })) return true;
  return scene.contact->friction || std::any_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair.friction.has_value(); });
}

// Publishes friction before damping, the order in which dissipation is summed.
void publish(World& world, bool friction_record) {
  for (const auto& term : world.elastic_terms) world.records.publish(*term);
  if (!world.gravity.isZero())
    world.records.add(EnergyRecord{"gravity", EnergyKind::weight, [&world](const VecX& x) { return weight_of_free_vertices(world, x); }});
  for (const auto& load : world.load_terms) world.records.publish(*load);
  for (const Term* term : world.contact_terms()) world.records.publish(*term);
  if (!world.friction && friction_record) world.records.add(zero_friction_record());
  for (const auto& term : world.damping_terms) world.records.publish(*term);
}

// Checks the drives against what follows them, and starts the protocols.
void begin_protocols(const SceneConfig& scene, const Value& root, World& world) {
  if (scene.protocols.empty()) return;
  with_source_location(root.find("protocols"), [&] {
    if (any_remeshed(scene)) throw InputError("protocols follow objects whose vertices stay, and objects may be meshed anew (remesh); take one of the two away");
    world.drives.check();
  });
  world.drives.begin(world.start.time, world.start.history);
}

}  // namespace

const Value* entry_of(const Value* list, size_t i) { return list && i < list->items.size() ? &list->items[i] : nullptr; }

std::string source_location(const Value& root, const std::string& list, size_t i) {
  const Value* value = entry_of(root.find(list), i);
  return value ? value->mark.text() + ": " : "";
}

std::unique_ptr<World> build_world(const SceneConfig& scene, const Value& root, const RunTimes& times, PhaseClock& clock, const InitialStateFromRun* earlier,
                                   const FlowedMeshes& flowed) {
  auto world = std::make_unique<World>();
  std::set<std::string> names;
  std::vector<Mesh> meshes;
  std::vector<MeshDigest> digests;
  std::vector<std::vector<std::string>> notes;  // of the shapes
  for_each_object(scene, root, [&](size_t i) {
    const ObjectConfig& object = scene.objects[i];
    if (!names.insert(object.name).second)
      throw InputError(fmt::format("two objects are named '{}'; names must differ", object.name));
    const auto shape = mesh_of_shape(*object.shape);
    Mesh mesh = shape->mesh;
    digests.push_back(digest_of(mesh));
    mesh = with_elements(placed_mesh(std::move(mesh), object), object, digests.back());
    if (scene.contact) refuse_unmeasured_contact(mesh, object.name, object.rod.has_value(), object.particle.has_value());
    meshes.push_back(std::move(mesh));
    notes.push_back(shape->notes);
  });
  world->start_notes = adjust_overclosures(scene, root, meshes);
  for_each_object(scene, root, [&](size_t i) {
    const auto remeshed = flowed.find(scene.objects[i].name);
    if (remeshed == flowed.end()) add_body(scene.objects[i], meshes[i], nullptr, *world);
    else add_body(scene.objects[i], mesh_of(remeshed->second, scene.objects[i], scene), &remeshed->second, *world);
    world->bodies.back().digest = digests[i];
    world->bodies.back().from_file = scene.objects[i].shape->reads_files();
    world->bodies.back().notes = std::move(notes[i]);
    world->bodies.back().energies = scene.objects[i].energies;
    world->bodies.back().environment = scene.environment ? &*scene.environment : nullptr;
  });
  meshes.clear();
  world->mass = world->gravitational_mass = VecX::Zero(world->rest.size() / 3);
  world->prescribed_motion = PrescribedMotion(static_cast<int>(world->rest.size()) / 3);
  for_each_object(scene, root, [&](size_t i) {
    if (scene.objects[i].body) add_frame(scene.objects[i], static_cast<int>(i), *world);
    if (scene.objects[i].surface && !scene.contact)
      throw InputError(fmt::format("object '{}' has a `surface` for contact, and there is none; take it away, or give a contact "
                                   "section", scene.objects[i].name));
    if (scene.objects[i].surface) add_refined_surface(scene.objects[i], static_cast<int>(i), *world);
  });
  add_named_selections(scene, root, *world);
  for_each_object(scene, root, [&](size_t i) { add_twists(scene.objects[i], static_cast<int>(i), *world); });
  for_each_object(scene, root, [&](size_t i) { add_spins(scene.objects[i], static_cast<int>(i), *world); });
  world->drives.add(scene.protocols);
  for_each_object(scene, root, [&](size_t i) { prescribe_motions(scene, static_cast<int>(i), *world); });
  for (const Dependence& d : world->constraints.lasting()) world->prescribed_motion.add_dependence(d);
  if (std::none_of(world->bodies.begin(), world->bodies.end(), [](const Body& b) { return b.movable; }))
    with_source_location(root.find("objects"), [] {
      throw InputError("nothing can move: the motion of every object is prescribed throughout; free one of them (motion, its "
                       "select, from and until)");
    });
  for_each_object(scene, root, [&](size_t i) { add_attachments(scene, static_cast<int>(i), *world); });
  for_each_object(scene, root, [&](size_t i) { add_energies(scene.objects[i], static_cast<int>(i), *world); });
  world->gravitational_mass = world->mass;
  for (const UnknownGroup& group : world->unknowns)
    if (group.length > 0)
      for (const int v : group.vertices) world->gravitational_mass(v) = 0;
  add_affine_terms(scene, root, times, *world);
  add_interactions(scene, root, *world);
  const std::vector<char> active = world->prescribed_motion.active(times.step / 2), free = world->prescribed_motion.free(active);
  world->dofs = DofMap(free, world->constraints.at(free, world->constraints.active(times.step / 2)), world->prescribed_motion.fixed_directions(active));
  check_mass(root, *world);
  add_loads(scene, root, *world);
  world->gravity = scene.gravity;
  if (!scene.gravity.isZero()) world->gravity_term.set_up(world->gravitational_mass, scene.gravity);
  start_state(scene, *world);
  if (earlier)
    with_source_location(root.find("start"), [&] { world->start_notes.push_back(start_from_run(scene.start.value_or(StartConfig{}), *earlier, scene, *world)); });
  world->meeting = meeting_groups(scene, *world, times.duration);
  build_contact(scene, root, times, clock, *world);
  begin_protocols(scene, root, *world);
  if (flowed.empty()) check_start(scene, root, *world);

  for (const auto& term : world->elastic_terms) world->terms.push_back(term.get());
  for (const auto& term : world->damping_terms) world->terms.push_back(term.get());
  if (!scene.gravity.isZero()) world->terms.push_back(&world->gravity_term);
  if (!world->load_term.empty()) world->terms.push_back(&world->load_term);
  for (const auto& load : world->load_terms) world->terms.push_back(load.get());
  for (const Term* term : world->contact_terms()) world->terms.push_back(term);
  if (!world->drives.empty()) world->participants.add(&world->drives);
  if (world->contact) world->participants.add(world->contact.get());
  for (const Body& body : world->bodies)
    if (body.rod) world->participants.add(body.rod.get());
  for (const auto& term : world->elastic_terms) world->participants.add(term.get());
  for (const auto& term : world->damping_terms) world->participants.add(term.get());
  for (LinearTerm* term : {static_cast<LinearTerm*>(&world->gravity_term), static_cast<LinearTerm*>(&world->load_term)})
    world->participants.add(term);
  for (const auto& load : world->load_terms) world->participants.add(load.get());
  for (Term* term : world->contact_terms()) world->participants.add(term);
  if (any_remeshed(scene)) {
    world->remeshed = std::make_unique<RemeshedEnergy>();
    world->participants.add(world->remeshed.get());
  }
  publish(*world, has_friction(scene));
  publish_driven_adhesion(*world);
  if (world->remeshed) world->remeshed->publish(world->records);
  check_remeshing(scene, root, *world);
  return world;
}

}  // namespace tack
