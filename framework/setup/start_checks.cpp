#include "framework/setup/start_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/affine/orthogonality_term.hpp"
#include "framework/contact/surface/overclosure.hpp"
#include "framework/setup/build_world.hpp"
#include "framework/world/containment.hpp"
#include "framework/world/describe_primitive.hpp"
#include "framework/world/infinite_energy.hpp"
#include "geometry/errors.hpp"
#include "geometry/exact/intersections.hpp"

namespace tack {
namespace {

// Returns true if contact.overclosure_adjustment could help. It is unset, and `start`, which excludes it, too.
bool may_push_out(const SceneConfig& scene) { return !scene.contact->overclosure_adjustment && !scene.start; }

// Returns the remedy for objects that intersect each other.
std::string apart(const SceneConfig& scene) {
  const char* pushed = may_push_out(scene) ? ", have them pushed apart if they overlap a little (contact.overclosure_adjustment: 1 mm)" : "";
  return fmt::format("move the objects apart (place.translate){} or turn their contact off (contact.pairs, contact: false)", pushed);
}

// Remedy for an object that intersects itself.
constexpr const char* mend_mesh =
    "have its mesh mended (`tack mesh repair MESH -o NEW`, or `repair` among the steps of a shape `processed`), or turn the object's contact with itself off "
    "(contact.pairs, contact: false)";

void check_intersections(const SceneConfig& scene, const Value& root, const World& world) {
  if (!world.contact) return;
  const ContactSurface& surface = world.contact->surface();
  const auto hits = find_intersections(surface.mesh, world.start.x, world.contact->colliding(), 5);
  if (hits.empty()) return;
  std::string list;
  int a = 0, b = 0;
  bool several = false;
  for (const auto& hit : hits) {
    const Edge& e = surface.mesh.edges[hit.edge];
    const Triangle& t = surface.mesh.triangles[hit.triangle];
    a = surface.mesh.vertex_object[e[0]];
    b = surface.mesh.vertex_object[t[0]];
    several = several || a != b;
    const auto n = [&](int v) { return world.index_in_body(v); };
    list += fmt::format("\n  edge ({}, {}) of '{}' meets triangle ({}, {}, {}) of '{}'", n(e[0]), n(e[1]),
                        world.bodies[a].name, n(t[0]), n(t[1]), n(t[2]), world.bodies[b].name);
  }
  throw InputError(fmt::format("{}the start intersects; {}:{}", source_location(root, "objects", static_cast<size_t>(std::max(a, b))),
                               several ? apart(scene) : mend_mesh, list));
}

// Checks for contacts that no edge-triangle intersection shows: coplanar edges, points and
// triangles that touch, such as those of a folded sheet or a rod that turns back on itself, and
// contact offsets, which extend the mesh.
void check_gaps(const SceneConfig& scene, const Value& root, World& world) {
  if (!world.contact) return;
  world.contact->cover(world.start.x, VecX());
  const auto found = find_overclosures(*world.contact, world.start.x);
  world.contact->clear_caches();
  if (found.empty()) return;
  std::string list;
  int later = 0;
  bool touches = false, several = false;
  for (const Overclosure& pair : found) {
    const int a = world.body_of(pair.first[0]), b = world.body_of(pair.second[0]);
    later = std::max({later, a, b});
    touches = touches || pair.touching;
    several = several || a != b;
    const std::string what = describe_primitive(world, pair.first) + " and " + describe_primitive(world, pair.second);
    list += pair.touching ? fmt::format("\n  {} touch at ({:.6g}, {:.6g}, {:.6g}) m", what, pair.at.x(), pair.at.y(), pair.at.z())
                          : fmt::format("\n  {} are {:.4g} m apart, and need {:.4g} m", what, pair.distance, pair.offset);
  }
  const std::string where = source_location(root, "objects", static_cast<size_t>(later));
  if (touches)
    throw InputError(fmt::format("{}the start touches{}:{}", where, several ? "; " + apart(scene)
                                 : " itself; take one of the parts out of the mesh, part them, or turn the object's contact with itself off "
                                   "(contact.pairs, contact: false)", list));
  throw InputError(fmt::format("{}the start violates the contact offsets; move the objects apart (place.translate){} or lower their "
                               "contact_offset:{}", where, several && may_push_out(scene) ? ", have them pushed apart (contact.overclosure_adjustment: 1 mm)" : "",
                               list));
}

void check_containment(const SceneConfig& scene, const Value& root, const World& world) {
  const auto found = find_containment(world);
  if (!found) return;
  const Body& inner = world.bodies[found->body];
  const Body& outer = world.bodies[found->solid];
  const Vec3 x = vertex(world.start.x, found->vertex);
  throw InputError(fmt::format("{}object '{}' is inside of '{}' at the start (its vertex {} at ({:.6g}, {:.6g}, {:.6g}) m lies "
                               "in tet {}); {}",
                               source_location(root, "objects", static_cast<size_t>(found->body)), inner.name, outer.name,
                               found->vertex - inner.first_vertex, x.x(), x.y(), x.z(), found->tet, apart(scene)));
}

// Checks that materials bear the state in which another run ended: a Gent solid, for instance, has a largest stretch.
void check_energies(const SceneConfig& scene, World& world) {
  if (!scene.start) return;
  const auto joins = [&](const Term* term) {
    return term == world.affine || std::any_of(world.interactions.begin(), world.interactions.end(), [&](const ActingInteraction& i) {
             return std::find(i.terms.begin(), i.terms.end(), term) != i.terms.end();
           });
  };
  for (const auto& term : world.elastic_terms) {
    if (term->dynamic() || joins(term.get())) continue;
    term->load_history(world.start.history);
    if (const std::string why = describe_infinite_energy(world, *term, world.start.x); !why.empty())
      throw InputError(fmt::format("in the state of that run, {}; change the material, or leave the object out of start.objects", why));
  }
}

}  // namespace

void check_start(const SceneConfig& scene, const Value& root, World& world) {
  check_intersections(scene, root, world);
  check_gaps(scene, root, world);
  check_containment(scene, root, world);
  with_source_location(root.find("start"), [&] { check_energies(scene, world); });
}

}  // namespace tack
