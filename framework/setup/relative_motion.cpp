#include "framework/setup/relative_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/nearest.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// The motion relative to its carrier, then the motions of all carriers in turn.
class RelativeMotion : public Motion {
 public:
  RelativeMotion(const Motion& own, std::vector<const Motion*> carriers)
      : Motion(own.from(), own.until()), own_(own), carriers_(std::move(carriers)) {
    if (from() > 0) start_inverse_ = carrier_map(from()).inverse();
  }
  void set_positions(std::span<const int> vertices, const VecX& rest, const VecX& reference, double t, VecX& x) const override {
    own_.set_positions(vertices, rest, reference, t, x);
    // A vertex that is prescribed later moves with the carrier from its position then.
    const RigidMap map = carrier_map(t) * start_inverse_;
    for (const int v : vertices) vertex(x, v) = map(vertex(x, v));
  }
  std::vector<double> corners() const override {
    std::vector<double> times = own_.corners();
    for (const Motion* carrier : carriers_) {
      const std::vector<double> more = carrier->corners();
      times.insert(times.end(), more.begin(), more.end());
    }
    return times;
  }
  bool moves() const override {
    return own_.moves() || std::any_of(carriers_.begin(), carriers_.end(), [](const Motion* m) { return m->moves(); });
  }
  bool rigid() const override { return own_.rigid(); }

 private:
  RigidMap carrier_map(double t) const {
    RigidMap map;
    for (const Motion* carrier : carriers_) map = *carrier->pose(t) * map;
    return map;
  }

  const Motion& own_;
  std::vector<const Motion*> carriers_;
  RigidMap start_inverse_;
};

std::string time_of(double t) { return std::isfinite(t) ? fmt::format("{} s", t) : "the end"; }

const ObjectConfig& object_named(const std::string& name, const std::string& who, const SceneConfig& scene) {
  std::vector<std::string> names;
  for (const ObjectConfig& object : scene.objects) {
    if (object.name == name) return object;
    names.push_back(object.name);
  }
  throw InputError(fmt::format("{}: its carrier '{}' is no object{}", who, name, suggestion(name, names, "objects")));
}

const Motion& carrier_of(const Motion& motion, const std::string& who, const SceneConfig& scene) {
  const ObjectConfig& object = object_named(motion.carrier(), who, scene);
  for (const auto& other : object.motion)
    if (other->pose(0) && !other->partial() && other->selection().type() == std::string("all") && other->from() <= motion.from() &&
        other->until() >= motion.until())
      return *other;
  throw InputError(fmt::format("{}: object '{}' has no single rigid motion of all its vertices from {} to {}; give it one (fixed, translate, rotate, "
                               "hinge, keyframes), or this one a span (from, until) within that", who, object.name, time_of(motion.from()),
                               time_of(motion.until())));
}

}  // namespace

std::unique_ptr<Motion> relative_motion(const Motion& motion, const std::string& name, const std::string& object, const SceneConfig& scene) {
  if (motion.carrier().empty()) return nullptr;
  std::vector<const Motion*> carriers;
  std::vector<std::string> passed = {object};
  for (const Motion* at = &motion; !at->carrier().empty(); at = carriers.back()) {
    if (std::find(passed.begin(), passed.end(), at->carrier()) != passed.end())
      throw InputError(fmt::format("{}: its carrier '{}' is carried by itself in the end; take `carrier` away from one of them", name, motion.carrier()));
    passed.push_back(at->carrier());
    carriers.push_back(&carrier_of(*at, name, scene));
  }
  return std::make_unique<RelativeMotion>(motion, std::move(carriers));
}

}  // namespace tack
