#include "framework/scene/attachment.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "framework/scene/extent.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/scene/world.hpp"
#include "geometry/distance/closest_feature.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/errors.hpp"
#include "geometry/tet_coordinates.hpp"

namespace tack {

void AttachConfig::fields(Fields& f) {
  f.component("select", select, "its vertices that follow");
  f.text("to", to, "the object that they follow").required();
  f.optional_number("within", within, units::length,
                    "how far from that object they may be; unless given, a thousandth of its size").nonnegative();
  f.optional_number("until", until, units::time, "when they are let go, with the velocity they have; never unless given")
      .positive();
}

namespace {

constexpr double of_size = 1e-3;   // the usual `within`
constexpr double touching = 1e-9;  // of the size

std::vector<std::pair<int, double>> weights_on(const Tet& tet, const VecX& rest, const Vec3& point) {
  const auto w = tet_coordinates({vertex(rest, tet[0]), vertex(rest, tet[1]), vertex(rest, tet[2]), vertex(rest, tet[3])}, point);
  return {{tet[0], w[0]}, {tet[1], w[1]}, {tet[2], w[2]}, {tet[3], w[3]}};
}

double least(const std::vector<std::pair<int, double>>& weights) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [unused, w] : weights) least = std::min(least, w);
  return least;
}

// A vertex of the other mesh that a point coincides with is all that it follows.
void snap(std::vector<std::pair<int, double>>& weights) {
  constexpr double round_off = 1e-10;
  for (const auto& [v, w] : weights)
    if (std::abs(w - 1) < round_off) {
      const int same = v;
      weights = {{same, 1.0}};
      return;
    }
  std::erase_if(weights, [](const auto& entry) { return std::abs(entry.second) < round_off; });
}

// One object that others may be attached to, at rest.
class Target {
 public:
  Target(const World& world, int index)
      : world_(world), body_(world.bodies[index]), size_(extent_of(body_, world.rest).diagonal().norm()) {}
  double size() const { return size_; }

  struct Place {
    std::vector<std::pair<int, double>> on;
    double distance = 0;  // of the point from the object [m]
    double off = 0;       // from where `on` puts it [m]
  };
  Place of(const Vec3& point) const {
    Place place;
    const Triangle* closest = nullptr;
    double least_square = std::numeric_limits<double>::infinity();
    for (const Triangle& t : body_.triangles) {
      const double d = point_triangle_distance(point, at(t[0]), at(t[1]), at(t[2]));
      if (d < least_square) least_square = d, closest = &t;
    }
    place.distance = closest ? std::sqrt(least_square) : std::numeric_limits<double>::infinity();
    if (!body_.frame.empty()) {
      place.on = weights_on({body_.frame[0], body_.frame[1], body_.frame[2], body_.frame[3]}, world_.rest, point);
    } else if (!body_.tets.empty()) {
      place.on = on_tets(point, closest);
      if (least(place.on) >= -touching) place.distance = 0;
    } else if (closest) {
      place.on = on_triangle(*closest, point);
      place.off = place.distance;
    }
    snap(place.on);
    return place;
  }

 private:
  Vec3 at(int v) const { return vertex(world_.rest, v); }

  // In the tet that holds it, or else in that of the closest face.
  std::vector<std::pair<int, double>> on_tets(const Vec3& point, const Triangle* closest) const {
    const Tet* chosen = nullptr;
    for (const Tet& t : body_.tets) {
      if (least(weights_on(t, world_.rest, point)) >= -touching) return weights_on(t, world_.rest, point);
      if (closest && std::all_of(closest->begin(), closest->end(),
                                 [&](int v) { return std::find(t.begin(), t.end(), v) != t.end(); }))
        chosen = &t;
    }
    return weights_on(*chosen, world_.rest, point);
  }

  std::vector<std::pair<int, double>> on_triangle(const Triangle& t, const Vec3& point) const {
    const Vec3 a = at(t[0]), u = at(t[1]) - a, v = at(t[2]) - a;
    Eigen::Matrix<double, 3, 2> edges;
    edges << u, v;
    const Eigen::Vector2d w = (edges.transpose() * edges).inverse() * (edges.transpose() * (point - a));
    return {{t[0], 1 - w.sum()}, {t[1], w(0)}, {t[2], w(1)}};
  }

  const World& world_;
  const Body& body_;
  double size_;
};

int target_index(const AttachConfig& attach, int own, const World& world, const std::string& name) {
  const int index = world.index_of(attach.to, name + ": ");
  if (index == own) throw InputError(fmt::format("{}: an object cannot be attached to itself", name));
  return index;
}

}  // namespace

void add_attachments(const SceneConfig& scene, int index, World& world) {
  const ObjectConfig& object = scene.objects[index];
  std::vector<int> taken;
  for (size_t i = 0; i < object.attach.size(); ++i) {
    const AttachConfig& attach = object.attach[i];
    const std::string name = fmt::format("attach {} of '{}'", i, object.name);
    const int to = target_index(attach, index, world, name);
    const Target target(world, to);
    const double within = attach.within.value_or(of_size * target.size());
    Tie tie{name, {}, 0, attach.until.value_or(std::numeric_limits<double>::infinity())};
    double closest = std::numeric_limits<double>::infinity();
    for (const int v : select(*attach.select, world.selection_context(index))) {
      const int local = v - world.bodies[index].first_vertex;
      if (world.script.ever_held(v))
        throw InputError(fmt::format("{}: vertex {} is held by a motion as well; take it out of one of the two selections",
                                     name, local));
      if (std::find(taken.begin(), taken.end(), v) != taken.end())
        throw InputError(fmt::format("{}: vertex {} is attached twice; take it out of one of the selections", name, local));
      taken.push_back(v);
      Target::Place place = target.of(vertex(world.rest, v));
      if (place.distance > within || place.off > touching * target.size())
        throw InputError(fmt::format("{}: vertex {} is {:.4g} m away from '{}'{}; move the objects together (place), select "
                                     "fewer vertices{}", name, local, place.distance, attach.to,
                                     place.distance > within ? "" : ", which has no tets to follow beyond its surface",
                                     place.distance > within ? " or raise `within`" : ""));
      closest = std::min(closest, place.distance);
      tie.dependences.push_back({v, std::move(place.on)});
    }
    if (closest <= touching * target.size()) world.attached.emplace_back(std::min(index, to), std::max(index, to));
    world.bindings.add(std::move(tie));
  }
}

}  // namespace tack
