#include "framework/scene/springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/scene/build_world.hpp"
#include "framework/scene/spring_term.hpp"
#include "geometry/errors.hpp"

namespace tack {

void SpringConfig::End::fields(Fields& f) {
  f.text("object", object, "name of the object").required();
  f.component("select", select, "its vertices");
}

void SpringConfig::fields(Fields& f) {
  f.text("name", name, "what probes and messages call them").required().line();
  f.object("from", from, "vertices that have one spring each");
  f.object("to", to, "vertices of which each is tied to the one that is nearest at the start");
  f.number("stiffness", stiffness, units::stiffness, "of each spring").required().positive();
  f.optional_number("length", length, units::length, "at which it exerts no force; unless given, its length at the start")
      .nonnegative();
  f.optional_number("breaking_force", breaking_force, units::force,
                    "of each: one that is strained by more at the end of a step is broken from then on; unless given, none breaks")
      .positive();
}

namespace {

std::vector<int> vertices_of(const SpringConfig::End& end, const World& world) {
  return select(*end.select, world.selection_context(world.index_of(end.object)));
}

}  // namespace

void add_springs(const SceneConfig& scene, const Value& root, World& world) {
  std::set<std::string> names;
  for (size_t i = 0; i < scene.springs.size(); ++i) {
    const SpringConfig& config = scene.springs[i];
    const Value* list = root.find("springs");
    at_place(list && i < list->items.size() ? &list->items[i] : nullptr, [&] {
      if (!names.insert(config.name).second)
        throw InputError(fmt::format("two springs are named '{}'; names must differ", config.name));
      auto term = std::make_unique<SpringTerm>(config.name);
      const std::vector<int> to = vertices_of(config.to, world);
      for (const int v : vertices_of(config.from, world)) {
        const auto distance = [&](int w) { return (vertex(world.rest, v) - vertex(world.rest, w)).norm(); };
        const int nearest = *std::min_element(to.begin(), to.end(), [&](int a, int b) { return distance(a) < distance(b); });
        if (nearest == v) throw InputError(fmt::format("springs '{}' would tie a vertex to itself; choose other ends", config.name));
        SpringTerm::Spring spring{config.stiffness, config.length.value_or(distance(nearest))};
        if (config.breaking_force) spring.strength = *config.breaking_force;
        term->add({v, nearest}, spring);
      }
      world.springs.push_back(term.get());
      world.elastic_terms.push_back(std::move(term));
    });
  }
}

}  // namespace tack
