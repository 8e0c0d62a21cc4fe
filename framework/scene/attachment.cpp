#include "framework/scene/attachment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "framework/scene/scene_config.hpp"
#include "framework/world/embedding.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {

void AttachConfig::fields(Fields& f) {
  f.component("select", select, "vertices that are attached");
  f.text("to", to, "object that they are attached to").required();
  f.optional_number("within", within, units::length,
                    "largest initial distance from that object; a thousandth of its size unless given").nonnegative();
  f.optional_number("until", until, units::time, "time of release; the vertices keep their velocity; never unless given")
      .positive();
}

namespace {

constexpr double distance_per_size = 1e-3;  // default of `within`, as a fraction of the other object's size

int host_index(const AttachConfig& attach, int own, const World& world, const std::string& name) {
  const int index = world.index_of(attach.to, name + ": ");
  if (index == own) throw InputError(fmt::format("{}: an object cannot be attached to itself", name));
  return index;
}

}  // namespace

void add_attachments(const SceneConfig& scene, int index, World& world) {
  const ObjectConfig& object = scene.objects[index];
  std::vector<int> attached;
  for (size_t i = 0; i < object.attach.size(); ++i) {
    const AttachConfig& attach = object.attach[i];
    const std::string name = fmt::format("attach {} of '{}'", i, object.name);
    const int to = host_index(attach, index, world, name);
    const Embedding host(world, to);
    const double within = attach.within.value_or(distance_per_size * host.size());
    TimedConstraint timed{name, {}, 0, attach.until.value_or(std::numeric_limits<double>::infinity())};
    double closest = std::numeric_limits<double>::infinity();
    for (const int v : select(*attach.select, world.selection_context(index))) {
      const int local = v - world.bodies[index].first_vertex;
      if (world.prescribed_motion.ever_fixed(v))
        throw InputError(fmt::format("{}: vertex {} is prescribed by a motion as well; take it out of one of the two selections",
                                     name, local));
      if (std::find(attached.begin(), attached.end(), v) != attached.end())
        throw InputError(fmt::format("{}: vertex {} is attached twice; take it out of one of the selections", name, local));
      attached.push_back(v);
      Embedding::Attachment attachment = host.of(vertex(world.rest, v));
      if (attachment.distance > within || attachment.error > Embedding::touching * host.size())
        throw InputError(fmt::format("{}: vertex {} is {:.4g} m away from '{}'{}; move the objects together (place), select "
                                     "fewer vertices{}", name, local, attachment.distance, attach.to,
                                     attachment.distance > within ? "" : ", which has no tets to follow beyond its surface",
                                     attachment.distance > within ? " or raise `within`" : ""));
      closest = std::min(closest, attachment.distance);
      timed.dependences.push_back({v, std::move(attachment.on)});
    }
    if (closest <= Embedding::touching * host.size()) world.attached.emplace_back(std::min(index, to), std::max(index, to));
    world.constraints.add(std::move(timed));
  }
}

}  // namespace tack
