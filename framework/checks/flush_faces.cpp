#include "framework/checks/flush_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/body/extent.hpp"
#include "framework/contact/normal_law.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/scene/copied_lines.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

constexpr double filled = 0.99;  // of the side of a box by the surface: the face is flat, and no part of it is missing

class FlushFaces {
 public:
  FlushFaces(const SceneConfig& scene, const World& world) : scene_(scene), world_(world), distance_(scene.contact->contact_distance) {
    for (const Body& body : world.bodies) boxes_.push_back(extent_of(body, world.start.x));
  }

  std::vector<Warning> lines() {
    std::vector<int> order(boxes_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return boxes_[a].min().x() < boxes_[b].min().x(); });
    double range = 0;
    for (const PairLaw& law : world_.contact->pairs().laws()) range = std::max(range, law.range());
    for (size_t i = 0; i < order.size(); ++i)
      for (size_t j = i + 1; j < order.size() && boxes_[order[j]].min().x() <= boxes_[order[i]].max().x() + range; ++j)
        examine(std::min(order[i], order[j]), std::max(order[i], order[j]));
    return lines_.warnings();
  }

 private:
  bool is_guided(int body) const {
    const ObjectConfig& object = scene_.objects[body];
    const auto attached = [&](const auto& pair) { return pair.first == body || pair.second == body; };
    return !world_.bodies[body].movable || !object.motion.empty() || !object.attach.empty() ||
           std::any_of(world_.attached.begin(), world_.attached.end(), attached);
  }
  bool is_pressed(int body, int axis) const {
    return !is_guided(body) && (world_.gravity(axis) != 0 || !scene_.objects[body].loads.empty());
  }

  // Returns the law of two bodies if it neither acts along their surfaces nor pulls; null
  // otherwise.
  const PairLaw* slippery(int a, int b) const {
    const PairTable& pairs = world_.contact->pairs();
    if (pairs.has_regions(a, b)) return nullptr;
    const int law = pairs.codimensional(a, b).law;
    if (law < 0 || pairs.tangential(law).acts()) return nullptr;
    for (const auto& part : pairs.laws()[law].laws())
      if (dynamic_cast<const NormalAdhesion*>(part.get())) return nullptr;
    return &pairs.laws()[law];
  }

  // Returns whether the surface of a body fills the upper or lower side of its box across the axis.
  bool fills(int body, int axis, bool upper) const {
    const Eigen::AlignedBox3d& box = boxes_[body];
    const double level = upper ? box.max()(axis) : box.min()(axis);
    double area = 0;
    for (const Triangle& t : world_.bodies[body].triangles) {
      const bool on_side = std::all_of(t.begin(), t.end(), [&](int v) { return std::abs(world_.start.x(3 * v + axis) - level) < distance_ / 10; });
      if (on_side) area += triangle_area(vertex(world_.start.x, t[0]), vertex(world_.start.x, t[1]), vertex(world_.start.x, t[2]));
    }
    return area > filled * box.volume() / box.sizes()(axis);
  }

  void examine(int a, int b) {
    const auto alike = [&](int axis) {
      return std::abs(boxes_[a].min()(axis) - boxes_[b].min()(axis)) < distance_ && std::abs(boxes_[a].max()(axis) - boxes_[b].max()(axis)) < distance_;
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!alike((axis + 1) % 3) || !alike((axis + 2) % 3)) continue;
      const bool above = boxes_[b].center()(axis) > boxes_[a].center()(axis);
      const double gap = above ? boxes_[b].min()(axis) - boxes_[a].max()(axis) : boxes_[a].min()(axis) - boxes_[b].max()(axis);
      if (!is_pressed(a, axis) && !is_pressed(b, axis)) continue;
      const PairLaw* law = slippery(a, b);
      if (!law || gap > law->range() + distance_ || !fills(a, axis, above) || !fills(b, axis, !above)) continue;
      const int pressed = is_pressed(b, axis) ? b : a, other = pressed == b ? a : b;
      lines_.add(scene_.objects[pressed], WarningKind::flush_faces,
                  fmt::format("'{}' and '{}' lie on each other with flat faces of equal extent and without friction: they slide off each other as their meshes lie; make one of "
                              "the faces larger by more than contact.distance ({:.4g} m), or give the pair friction", world_.bodies[pressed].name, world_.bodies[other].name, distance_));
    }
  }

  const SceneConfig& scene_;
  const World& world_;
  const double distance_;  // m: of contact
  std::vector<Eigen::AlignedBox3d> boxes_;
  CopiedLines lines_;
};

}  // namespace

std::vector<Warning> flush_face_warnings(const SceneConfig& scene, const World& world) {
  if (!world.contact || !scene.contact) return {};
  return FlushFaces(scene, world).lines();
}

}  // namespace tack
