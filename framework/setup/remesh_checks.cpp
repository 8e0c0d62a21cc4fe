#include "framework/setup/remesh_checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/setup/build_world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

bool named(const std::string& name, const ObjectConfig& object) {
  return name == "*" || name == object.name || std::find(object.groups.begin(), object.groups.end(), name) != object.groups.end();
}

// Returns the interaction that acts on the object; "": none.
std::string interaction_on(const ObjectConfig& object, const SceneConfig& scene) {
  for (const auto& interaction : scene.interactions)
    for (const std::string& name : interaction->objects())
      if (named(name, object)) return std::string(interaction->type());
  return "";
}

bool has_attached_objects(const ObjectConfig& object, const SceneConfig& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const ObjectConfig& other) {
    return std::any_of(other.attach.begin(), other.attach.end(), [&](const AttachConfig& attach) { return attach.to == object.name; });
  });
}

// Returns why the object cannot be remeshed, with the remedy; "": it can.
std::string obstacle(const ObjectConfig& object, const Body& body, const SceneConfig& scene, const World& world) {
  if (object.body) return "it is an affine body, which does not flow; take `remesh` away";
  if (body.tets.empty()) return "it has no tets; take `remesh` away, or use a tet mesh or shape";
  if (!body.sheet.empty() || !body.edges.empty() || !body.points.empty())
    return "it has triangles, edges or points beside its tets; make them an object of their own";
  if (!body.movable) return "its motion is prescribed throughout, so that it does not flow; take `remesh` away";
  if (object.elements != Elements::linear) return "its elements are not linear; take `elements` away, or `remesh`";
  if (object.surface) return "its contact surface is refined; use finer cells and take `surface` away";
  if (!object.attach.empty()) return "it is attached to another object; hold it by contact, or take `remesh` away";
  if (has_attached_objects(object, scene)) return "another object is attached to it; hold that by contact or motions, or take `remesh` away";
  if (const std::string type = interaction_on(object, scene); !type.empty())
    return fmt::format("the interaction {} acts on it and refers to its tets; take one of the two away", type);
  if (object.energies.size() != 1 || object.energies.front()->selection())
    return "it needs exactly one energy, on all of its tets; use von_mises alone";
  const auto& records = world.records.exchangeable();
  const bool known = std::any_of(records.begin(), records.end(), [&](const ExchangeableTets& r) { return r.body == body.name; });
  if (!known) return fmt::format("{} does not flow, or its state cannot be transferred to other tets; choose von_mises, or take `remesh` away", object.energies.front()->type());
  return "";
}

}  // namespace

void drop_interior_vertices(const std::string& motion, const Body& body, std::vector<int>& vertices) {
  std::vector<char> outside(static_cast<size_t>(body.vertex_count), 0);
  for (const Triangle& t : body.triangles)
    for (const int v : t) outside[v - body.first_vertex] = 1;
  const auto inside = [&](int v) { return !outside[v - body.first_vertex]; };
  const auto count = std::count_if(vertices.begin(), vertices.end(), inside);
  if (count > 0 && body.references.empty())
    throw InputError(fmt::format("{} prescribes {} vertices inside of '{}', which is remeshed as it flows (remesh): they would be replaced; select vertices of its "
                                 "surface alone, or take `remesh` away", motion, count, body.name));
  std::erase_if(vertices, inside);
}

bool any_remeshed(const SceneConfig& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [](const ObjectConfig& object) { return object.remesh.has_value(); });
}

void check_remeshing(const SceneConfig& scene, const Value& root, const World& world) {
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].remesh) continue;
    const std::string why = obstacle(scene.objects[i], world.bodies[i], scene, world);
    if (why.empty()) continue;
    const Value* object = entry_of(root.find("objects"), i);
    with_source_location(object && object->find("remesh") ? object->find("remesh") : object,
             [&] { throw InputError(fmt::format("object '{}' cannot be remeshed: {}", scene.objects[i].name, why)); });
  }
}

}  // namespace tack
