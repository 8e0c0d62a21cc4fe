#include "framework/setup/named_selections.hpp"

#include <fmt/format.h>

#include "framework/setup/build_world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Returns "scene.yaml:12:3: " for entry i of `selections` in a map.
std::string selection_location(const Value* map, size_t i) {
  return map ? source_location(*map, "selections", i) : "";
}

void add_group(Body& body, const std::string& name, std::vector<int> vertices) {
  for (int& v : vertices) v -= body.first_vertex;
  body.tags[name] = std::move(vertices);
}

void add_object_selections(const ObjectConfig& object, const Value* value, const VecX& rest, Body& body) {
  for (size_t i = 0; i < object.selections.size(); ++i) {
    const NamedSelection& named = object.selections[i];
    try {
      if (body.tags.count(named.name))
        throw InputError(fmt::format("object '{}' has a group '{}' already; names must differ", object.name, named.name));
      add_group(body, named.name, select(*named.select, {body, rest}));
    } catch (const InputError& error) {
      throw InputError(selection_location(value, i) + error.what());
    }
  }
}

// Returns the selected vertices of one body. A scene's selection may name a group that only another
// object has.
std::vector<int> chosen(const NamedSelection& named, const Body& body, const VecX& rest, std::string& why) {
  try {
    return named.select->choose({body, rest});
  } catch (const InputError& error) {
    why = fmt::format(" ({})", error.what());
    return {};
  }
}

}  // namespace

void add_named_selections(const SceneConfig& scene, const Value& root, World& world) {
  const Value* objects = root.find("objects");
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Value* object = entry_of(objects, i);
    add_object_selections(scene.objects[i], object, world.rest, world.bodies[i]);
  }
  for (size_t i = 0; i < scene.selections.size(); ++i) {
    const NamedSelection& named = scene.selections[i];
    bool any = false;
    std::string why;
    for (Body& body : world.bodies) {
      if (body.tags.count(named.name)) continue;
      const std::vector<int> vertices = chosen(named, body, world.rest, why);
      if (vertices.empty()) continue;
      add_group(body, named.name, vertices);
      any = true;
    }
    if (any) continue;
    throw InputError(fmt::format("{}selection '{}' chooses no vertex of any object{}; check its position and units, or "
                                 "whether objects have a group of that name", selection_location(&root, i), named.name, why));
  }
}

}  // namespace tack
