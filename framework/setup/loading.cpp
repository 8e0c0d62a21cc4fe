#include "framework/setup/loading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/body/extent.hpp"
#include "framework/core/disjoint_sets.hpp"
#include "framework/setup/overlap_tree.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Largest ratio of the speed after a collision to the speed of the impactor: elastic collision of a
// heavy body with a light one at rest.
constexpr double speed_ratio_max = 2;
constexpr double anywhere = 1e100;  // m: farther than any scene
constexpr int motion_samples = 32;  // sampling times of prescribed motions over the duration

bool is_named(const ObjectConfig& object, const std::string& name) {
  return name == "*" || object.name == name || std::find(object.groups.begin(), object.groups.end(), name) != object.groups.end();
}

// Returns, per body, the largest displacement of a vertex by a prescribed motion [m]; infinite if a motion has
// no finite position at some time. The step to that time ends the run with the reason.
std::vector<double> prescribed_displacements(const World& world, double duration) {
  std::vector<double> displacements(world.bodies.size(), 0);
  const PrescribedMotion& prescribed_motion = world.prescribed_motion;
  std::vector<std::pair<int, int>> moved;  // body, vertex
  for (const PrescribedMotion::Assignment& assignment : prescribed_motion.assignments())
    if (assignment.motion->moves())
      for (const int v : assignment.vertices)
        if (const int body = world.body_of(v); body >= 0 && !world.is_scalar_dof(v)) moved.emplace_back(body, v);
  for (const PrescribedMotion::Assignment& assignment : prescribed_motion.assignments())
    if (assignment.motion->unbounded() && !assignment.vertices.empty())
      if (const int body = world.body_of(assignment.vertices.front()); body >= 0) displacements[body] = std::numeric_limits<double>::infinity();
  if (moved.empty()) return displacements;
  for (int k = 1; k <= motion_samples; ++k) {
    const double t = duration * k / motion_samples;
    VecX x = world.rest;
    try {
      prescribed_motion.set_positions(prescribed_motion.active(t), world.rest, world.rest, t, x);
    } catch (const SimulationError&) {
      for (const auto& [body, v] : moved) displacements[body] = std::numeric_limits<double>::infinity();
      break;
    }
    for (const auto& [body, v] : moved)
      displacements[body] = std::max(displacements[body], (vertex(x, v) - vertex(world.rest, v)).norm());
  }
  return displacements;
}

class MeetingSearch {
 public:
  MeetingSearch(const SceneConfig& scene, const World& world, double duration)
      : scene_(scene), world_(world), duration_(duration), count_(static_cast<int>(world.bodies.size())), sets_(count_),
        displacement_(prescribed_displacements(world, duration)), speed_(count_, 0), driven_(count_, 0) {
    for (int i = 0; i < count_; ++i) {
      boxes_.push_back(extent_of(world.bodies[i], world.rest));
      if (movable(i)) speed_[i] = scene.objects[i].velocity.norm() + scene.objects[i].spin.norm() * diagonal(i) / 2;
      if (!scene.objects[i].loads.empty()) driven_[i] = 1;
    }
    join_connected();
    while (join_overlapping()) continue;
  }

  MeetingGroups groups() {
    MeetingGroups found;
    std::vector<int> number(count_, -1);
    for (int i = 0; i < count_; ++i) {
      if (!movable(i)) continue;
      int& of_root = number[root(i)];
      if (of_root < 0) {
        of_root = static_cast<int>(found.bodies.size());
        found.bodies.emplace_back();
      }
      found.bodies[of_root].push_back(i);
    }
    for_each_obstacle(search_boxes(), [&](int obstacle, int body) {
      if (displacement_[obstacle] > 0) found.pushed.emplace_back(obstacle, body);
    });
    std::sort(found.pushed.begin(), found.pushed.end());
    return found;
  }

  std::vector<Loading> loadings() {
    std::vector<Eigen::AlignedBox3d> boxes(count_);
    std::vector<Loading> groups(count_);
    for (int i = 0; i < count_; ++i) {
      if (!movable(i)) continue;
      boxes[root(i)].extend(boxes_[i]);
      groups[root(i)].speed = speed_[root(i)];
      for (const int v : world_.vertices_of(i))
        if (world_.prescribed_motion.ever_free(v)) groups[root(i)].weight += world_.gravitational_mass(v) * scene_.gravity.norm();
    }
    for_each_obstacle(search_boxes(), [&](int obstacle, int body) { boxes[root(body)].extend(boxes_[obstacle]); });
    std::vector<Loading> loadings(count_);
    for (int i = 0; i < count_; ++i) {
      if (!movable(i)) continue;
      loadings[i] = groups[root(i)];
      if (!scene_.gravity.isZero())
        loadings[i].speed = std::hypot(loadings[i].speed, std::sqrt(2 * boxes[root(i)].diagonal().dot(scene_.gravity.cwiseAbs())));
    }
    return loadings;
  }

 private:
  bool movable(int i) const { return world_.bodies[i].movable; }
  double diagonal(int i) const { return boxes_[i].diagonal().norm(); }
  int root(int i) { return sets_.find(i); }

  // Joins the groups of two bodies that may meet; returns true if anything changed. A fixed body joins no group, but its prescribed
  // displacement counts for the group.
  bool meet(int a, int b) {
    if (!movable(a) && !movable(b)) return false;
    if (!movable(a)) std::swap(a, b);
    const int one = root(a), other = root(b);
    if (!movable(b)) {
      if (displacement_[one] >= displacement_[b]) return false;
      displacement_[one] = displacement_[b];
      return true;
    }
    if (one == other) return false;
    sets_.join(one, other);
    const int both = root(one);
    speed_[both] = std::max(speed_[one], speed_[other]);
    displacement_[both] = std::max(displacement_[one], displacement_[other]);
    driven_[both] = driven_[one] || driven_[other];
    return true;
  }

  void join_connected() {
    for (const auto& [a, b] : world_.attached) meet(a, b);
    for (int i = 0; i < count_; ++i)
      for (const AttachConfig& attach : scene_.objects[i].attach)
        if (const int to = world_.body_index(attach.to); to >= 0) meet(i, to);
    for (const auto& interaction : scene_.interactions) {
      int first = -1;
      for (const std::string& name : interaction->objects())
        for (int i = 0; i < count_; ++i) {
          if (!is_named(scene_.objects[i], name)) continue;
          if (first >= 0) meet(first, i);
          driven_[root(i)] = 1;
          if (first < 0 || !movable(first)) first = i;
        }
    }
  }

  std::vector<Eigen::AlignedBox3d> search_boxes() {
    const double contact = scene_.contact ? scene_.contact->contact_distance : 0, fall = scene_.gravity.norm() * duration_ * duration_ / 2;
    std::vector<Eigen::AlignedBox3d> boxes = boxes_;
    for (int i = 0; i < count_; ++i) {
      const int group = root(i);
      double by = displacement_[group] + contact + scene_.objects[i].contact_offset + world_.bodies[i].radius;
      if (movable(i)) by += driven_[group] ? std::numeric_limits<double>::infinity() : std::max(diagonal(i), speed_ratio_max * (speed_[group] * duration_ + fall));
      by = std::min(by, anywhere);  // boxes have finite centres
      boxes[i].min().array() -= by;
      boxes[i].max().array() += by;
    }
    return boxes;
  }

  // Calls act(obstacle, body) for each fixed and each movable body whose boxes overlap.
  template <class Act>
  void for_each_obstacle(const std::vector<Eigen::AlignedBox3d>& boxes, const Act& act) const {
    for (int a = 0; a < count_; ++a) {
      if (movable(a)) continue;
      for (int b = 0; b < count_; ++b)
        if (movable(b) && boxes[a].intersects(boxes[b])) act(a, b);
    }
  }

  bool join_overlapping() {
    const std::vector<Eigen::AlignedBox3d> boxes = search_boxes();
    bool changed = false;
    const auto join = [&](int a, int b) { changed = meet(a, b) || changed; };
    std::vector<int> movables;
    for (int i = 0; i < count_; ++i)
      if (movable(i)) movables.push_back(i);
    OverlapTree(boxes, std::move(movables)).join_overlapping([&](int i) { return root(i); }, join);
    for_each_obstacle(boxes, [&](int obstacle, int body) {
      if (displacement_[obstacle] > 0) join(obstacle, body);
    });
    return changed;
  }

  const SceneConfig& scene_;
  const World& world_;
  const double duration_;  // s
  const int count_;
  DisjointSets sets_;
  std::vector<Eigen::AlignedBox3d> boxes_;           // of bodies, at rest [m]
  std::vector<double> displacement_, speed_;         // of groups, at their root; of fixed bodies [m, m/s]
  std::vector<char> driven_;                         // per group, at its root: it may be driven anywhere
};

}  // namespace

std::vector<Loading> loadings(const SceneConfig& scene, const World& world, double duration) {
  return MeetingSearch(scene, world, duration).loadings();
}

MeetingGroups meeting_groups(const SceneConfig& scene, const World& world, double duration) {
  return MeetingSearch(scene, world, duration).groups();
}

}  // namespace tack
