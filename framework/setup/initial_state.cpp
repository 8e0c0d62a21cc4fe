#include "framework/setup/initial_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "framework/config/describe.hpp"
#include "framework/config/nearest.hpp"
#include "framework/body/local_mesh.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

const StateObject& checked(const std::string& name, const InitialStateFromRun& earlier, const StateObject& here) {
  const StateObject& there = earlier.objects.at(name);
  MeshDigest was = there.mesh;
  was.vertices = here.mesh.vertices, was.groups = here.mesh.groups;  // size and groups may differ
  if (const std::string other = difference(was, here.mesh); !other.empty())
    throw InputError(fmt::format("object '{}' had another mesh in {} ({}); give it the same shape, or leave it out of start.objects", name,
                                 earlier.file, other));
  if (there.vertices.size() != here.vertices.size())
    throw InputError(fmt::format("object '{}' had {} vertices in {} beside those of its mesh (of affine bodies, finer surfaces, unknowns of energies), and has {} "
                                 "here; give it the same `body`, `surface` and energies, or leave it out of start.objects", name,
                                 there.vertices.size() - there.mesh.vertex_count, earlier.file, here.vertices.size() - here.mesh.vertex_count));
  return there;
}

std::string names_of(const std::map<std::string, StateObject>& objects) {
  std::vector<std::string> names;
  for (const auto& [name, _] : objects) names.push_back(name);
  if (names.size() > 8) {
    names.resize(8);
    names.push_back("...");
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

// Returns the chosen objects in the scene's order.
std::vector<const ObjectConfig*> chosen(const StartConfig& start, const InitialStateFromRun& earlier, const SceneConfig& scene) {
  std::vector<const ObjectConfig*> all;
  const auto among = [](const std::vector<std::string>& list, const std::string& name) { return std::find(list.begin(), list.end(), name) != list.end(); };
  for (const ObjectConfig& object : scene.objects) {
    const bool named = among(start.objects, object.name) ||
                       std::any_of(object.groups.begin(), object.groups.end(), [&](const std::string& group) { return among(start.objects, group); });
    if (named && !earlier.objects.contains(object.name))
      throw InputError(fmt::format("there is no object '{}' in {}; it has {}", object.name, earlier.file, names_of(earlier.objects)));
    if (named || (start.objects.empty() && earlier.objects.contains(object.name))) all.push_back(&object);
  }
  for (const std::string& name : start.objects)
    if (std::none_of(scene.objects.begin(), scene.objects.end(), [&](const ObjectConfig& o) { return o.name == name || among(o.groups, name); })) {
      std::vector<std::string> names;
      for (const ObjectConfig& o : scene.objects) names.push_back(o.name), names.insert(names.end(), o.groups.begin(), o.groups.end());
      throw InputError(fmt::format("there is no object or group '{}'{}", name, suggestion(name, names, "objects and groups")));
    }
  if (all.empty())
    throw InputError(fmt::format("no object of the scene is in {}, which has {}; name them alike, or take `start` out", earlier.file,
                                 names_of(earlier.objects)));
  return all;
}

// Copies the history arrays whose names begin with the object's.
void copy_history(const ObjectConfig& object, const InitialStateFromRun& earlier, State& state) {
  const std::string prefix = object.name + "/";
  bool any = false;
  for (auto it = earlier.history.lower_bound(prefix); it != earlier.history.end() && it->first.starts_with(prefix); ++it) {
    if (!it->second.keys.empty()) continue;  // shared with other objects
    state.history.insert(*it);
    any = true;
  }
  if (any && earlier.energies.at(object.name) != energies_text(object))
    throw InputError(fmt::format("object '{}' has history variables in {} (plastic strain, turns, frames), and its energies or elements differ now; "
                                 "give it the same, or leave it out of start.objects", object.name, earlier.file));
}

// New indices of the earlier state's vertices and objects; -1: not chosen.
struct NewIndices {
  std::vector<int> vertices, objects;
};

// Copies keyed history: entries of a point and another object, both chosen, renumbered.
void copy_keyed_history(const InitialStateFromRun& earlier, const NewIndices& indices, State& state) {
  for (const auto& [name, there] : earlier.history) {
    const bool keyed = !there.keys.empty() && static_cast<int>(there.keys.size()) == there.entries();
    if (!keyed) continue;
    std::vector<std::pair<std::array<int, 2>, int>> kept;  // new key, entry in the earlier state
    for (int i = 0; i < there.entries(); ++i) {
      const auto& [vertex, object] = there.keys[i];
      if (vertex < 0 || object < 0 || vertex >= static_cast<int>(indices.vertices.size()) || object >= static_cast<int>(indices.objects.size()))
        throw InputError(fmt::format("{}: its history '{}' does not fit its objects; write it again", earlier.file, name));
      if (indices.vertices[vertex] >= 0 && indices.objects[object] >= 0) kept.push_back({{indices.vertices[vertex], indices.objects[object]}, i});
    }
    if (kept.empty()) continue;
    std::sort(kept.begin(), kept.end());
    HistoryArray here{there.width, {}, {}};
    for (const auto& [key, i] : kept) {
      here.keys.push_back(key);
      here.values.insert(here.values.end(), there.values.begin() + i * there.width, there.values.begin() + (i + 1) * there.width);
    }
    state.history[name] = std::move(here);
  }
}

// Copies unknowns and history of interactions whose objects are all chosen.
void copy_interactions(const std::map<std::string, StateObject>& here, const std::vector<const ObjectConfig*>& objects, const StartConfig& start,
                       const InitialStateFromRun& earlier, World& world) {
  const auto taken = [&](int body) {
    return std::any_of(objects.begin(), objects.end(), [&](const ObjectConfig* object) { return object->name == world.bodies[body].name; });
  };
  const auto refuse = [&](const ActingInteraction& interaction, const std::string& what, int there, int now) {
    throw InputError(fmt::format("interaction '{}' had {} {} in {}, and has {} here; name it otherwise, or give it the same ends", interaction.name, there,
                                 what, earlier.file, now));
  };
  State& s = world.start;
  for (const ActingInteraction& interaction : world.interactions) {
    if (!std::all_of(interaction.bodies.begin(), interaction.bodies.end(), taken)) continue;
    for (const ActingInteraction::HistoryShape& declared : interaction.history) {
      const auto there = earlier.history.find(declared.name);
      if (there == earlier.history.end()) continue;
      if (there->second.width != declared.width || there->second.entries() != declared.entries)
        refuse(interaction, fmt::format("entries of '{}'", declared.name), there->second.entries(), declared.entries);
      s.history.insert(*there);
    }
    const auto then = earlier.objects.find(interaction.name), now = here.find(interaction.name);
    if (then == earlier.objects.end() || now == here.end()) continue;
    const std::vector<int>&from = then->second.vertices, &to = now->second.vertices;
    if (from.size() != to.size()) refuse(interaction, "unknowns", static_cast<int>(from.size()), static_cast<int>(to.size()));
    for (size_t k = 0; k < to.size(); ++k) {
      vertex(s.x, to[k]) = vertex(earlier.x, from[k]);
      const bool moves = start.velocities && world.dofs.moves(to[k]);
      vertex(s.v, to[k]) = moves ? Vec3(vertex(earlier.v, from[k])) : Vec3::Zero();
      vertex(s.a, to[k]) = moves ? Vec3(vertex(earlier.a, from[k])) : Vec3::Zero();
    }
  }
}

}  // namespace

std::map<std::string, StateObject> state_objects(const World& world) {
  std::map<std::string, StateObject> objects;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    objects[body.name] = {world.vertices_of(static_cast<int>(i)), body.references.empty() ? body.digest : digest_of(local_mesh(body, world.rest))};
  }
  for (const ActingInteraction& interaction : world.interactions) {
    std::vector<int> vertices;
    for (const UnknownGroup& group : world.unknowns)
      if (group.body < 0 && group.name.starts_with(interaction.name + "/")) vertices.insert(vertices.end(), group.vertices.begin(), group.vertices.end());
    if (!vertices.empty()) objects[interaction.name] = {std::move(vertices), {}};
  }
  return objects;
}

std::string energies_text(const ObjectConfig& object) {
  std::string text;
  // The order of their history depends on the kind of elements.
  if (object.elements != Elements::linear) text += fmt::format("elements {}\n", static_cast<int>(object.elements));
  for (const auto& energy : object.energies) text += fmt::format("{}\n{}", energy->type(), to_yaml(fields_of(*energy)));
  return text;
}

std::string start_from_run(const StartConfig& start, const InitialStateFromRun& earlier, const SceneConfig& scene, World& world) {
  const std::map<std::string, StateObject> here = state_objects(world);
  State& s = world.start;
  const std::vector<const ObjectConfig*> objects = chosen(start, earlier, scene);
  NewIndices indices{std::vector<int>(static_cast<size_t>(earlier.x.size() / 3), -1), std::vector<int>(earlier.order.size(), -1)};
  for (const ObjectConfig* object : objects) {
    if (const auto at = std::find(earlier.order.begin(), earlier.order.end(), object->name); at != earlier.order.end())
      indices.objects[static_cast<size_t>(at - earlier.order.begin())] = world.body_index(object->name);
    const StateObject& now = here.at(object->name);
    const StateObject& then = checked(object->name, earlier, now);
    for (size_t k = 0; k < now.vertices.size(); ++k) {
      const int v = now.vertices[k], w = then.vertices[k];
      vertex(s.x, v) = vertex(earlier.x, w);
      indices.vertices[w] = v;
      const bool moves = start.velocities && world.dofs.moves(v);
      vertex(s.v, v) = moves ? Vec3(vertex(earlier.v, w)) : Vec3::Zero();
      vertex(s.a, v) = moves ? Vec3(vertex(earlier.a, w)) : Vec3::Zero();
    }
    copy_history(*object, earlier, s);
  }
  copy_keyed_history(earlier, indices, s);
  copy_interactions(here, objects, start, earlier, world);
  for (VecX* field : {&s.x, &s.v, &s.a}) world.dofs.update_dependents(*field);
  return fmt::format("{} of {} objects start as they were in {} (t = {:.6g} s)", objects.size(), scene.objects.size(), earlier.file, earlier.time);
}

}  // namespace tack
