#include "geometry/broad_phase/broad_phase.hpp"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/broad_phase/clearances.hpp"
#include "geometry/errors.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int kGrain = 4096;
constexpr double kFew = 0.4;  // of the vertices: so many are worth a search of theirs alone
constexpr double kTight = 0.05;  // of the skin: how far vertices may move in tight boxes

template <class Predicate>
bool all_of(const std::vector<int>& vertices, const Predicate& predicate) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, vertices.size(), kGrain), true,
      [&](const Range& range, bool so_far) {
        return so_far && std::all_of(vertices.begin() + range.begin(),
                                     vertices.begin() + range.end(), predicate);
      },
      [](bool a, bool b) { return a && b; });
}

// The largest absolute value, 0 for an empty vector.
double largest(const VecX& values) {
  double bound = 0.0;
  for (const double value : values) bound = std::max(bound, std::abs(value));
  return bound;
}

void check_finite(const VecX& values, const char* name) {
  if (values.allFinite()) return;
  Eigen::Index i = 0;
  while (std::isfinite(values[i])) ++i;
  throw SimulationError(fmt::format(
      "broad phase: {} of vertex {} is not finite ({}); the step before it diverged, reduce the "
      "time step or the stiffness",
      name, i / 3, values[i]));
}

}  // namespace

BroadPhase::BroadPhase(const CollisionMesh& mesh, CollidingObjects colliding)
    : mesh_(mesh), objects_(object_count(mesh)), finder_(mesh, std::move(colliding)) {}

bool BroadPhase::update(const VecX& x, const VecX& p, const Reaches& reaches, double skin) {
  check(x, p, reaches, skin);
  const bool known = builds_ > 0 && !stale_ && reaches.within(reaches_);
  if (known && inside(safe_boxes_, x, p)) return renew_clearances(x, p, skin) || (renew_distances(x, p), false);

  std::vector<char> changed;
  if (known) changed = strayed(x, p);
  if (changed.empty()) reaches_ = reaches;  // else those of the other candidates
  const double size = largest(x) + largest(p) + reaches_.largest_range() + skin;
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * size;
  inflate_reaches(rounding);
  std::vector<Aabb> boxes = boxes_around(x, p, 0.5 * skin + rounding);
  if (changed.empty()) {
    safe_boxes_ = std::move(boxes);
    finder_.find(safe_boxes_, inflation_, candidates_);
    find_clearances(mesh_, safe_boxes_, candidates_);
  } else {
    for (const int v : mesh_.vertices)
      if (changed[mesh_.vertex_object[v]]) safe_boxes_[v] = boxes[v];
    finder_.find_again(safe_boxes_, inflation_, changed, candidates_);
    if (tight_boxes_.empty()) find_fresh_clearances(mesh_, safe_boxes_, changed, finder_.fresh(), candidates_);
    else find_clearances(mesh_, safe_boxes_, candidates_);
  }
  partly_ = !changed.empty() && tight_boxes_.empty();
  tight_boxes_.clear();
  served_ = 0;
  stale_ = false;
  ++builds_;
  return true;
}

void BroadPhase::inflate_reaches(double rounding) {
  inflation_ = reaches_;
  for (double& reach : inflation_.surface) reach += rounding;
  for (double& reach : inflation_.edge) reach += rounding;
}

// A flag for each object that has left its safe boxes; empty if they are so many, or such, that all should be searched.
std::vector<char> BroadPhase::strayed(const VecX& x, const VecX& p) const {
  std::vector<char> objects(objects_, 0), fixed(objects_, 0);
  std::vector<int> size(objects_, 0);
  for (const int v : mesh_.vertices) {
    const int object = mesh_.vertex_object[v];
    ++size[object];
    fixed[object] |= !mesh_.vertex_movable[v];
    if (objects[object]) continue;
    const Aabb& box = safe_boxes_[v];
    if (box.contains(vertex(x, v)) && (p.size() == 0 || box.contains(vertex(x, v) + vertex(p, v)))) continue;
    objects[object] = 1;
  }
  int strayed = 0;
  for (int i = 0; i < objects_; ++i) {
    if (!objects[i]) continue;
    if (fixed[i]) return {};
    strayed += size[i];
  }
  if (strayed > kFew * static_cast<double>(mesh_.vertices.size())) return {};
  return objects;
}

// Distances are found anew where vertices have come to rest far from where they were found.
void BroadPhase::renew_distances(const VecX& x, const VecX& p) {
  if (largest(p) > 0 || largest(x - candidates_.reference) < reaches_.largest_range()) return;
  find_distances(mesh_, x, candidates_);
}

// After a while in which the safe boxes served, clearances are found in tight ones; where those are left too soon,
// that takes longer the next time.
bool BroadPhase::renew_clearances(const VecX& x, const VecX& p, double skin) {
  const double stray = kTight * skin;
  const bool tighten = ++served_ >= patience_ && largest(p) <= stray;
  if (tight_boxes_.empty() ? !tighten : inside(tight_boxes_, x, p)) return false;
  if (!tight_boxes_.empty() && !tighten) patience_ *= 4;
  tight_boxes_.clear();
  if (tighten) tight_boxes_ = boxes_around(x, p, stray);
  find_clearances(mesh_, tight_boxes_.empty() ? safe_boxes_ : tight_boxes_, candidates_);
  partly_ = false;
  served_ = 0;
  return true;
}

bool BroadPhase::inside(const std::vector<Aabb>& boxes, const VecX& x, const VecX& p) const {
  const auto inside = [&](int v) {
    return boxes[v].contains(vertex(x, v)) && (p.size() == 0 || boxes[v].contains(vertex(x, v) + vertex(p, v)));
  };
  return all_of(mesh_.vertices, inside);
}

void BroadPhase::dissolve_groups_of(const std::vector<int>& vertices) {
  std::vector<char> dissolved;
  for (const int v : vertices) {
    if (mesh_.vertex_group.empty() || mesh_.vertex_group[v] < 0) continue;
    if (dissolved.empty()) dissolved.resize(*std::max_element(mesh_.vertex_group.begin(), mesh_.vertex_group.end()) + 1);
    dissolved[mesh_.vertex_group[v]] = 1;
  }
  stale_ |= finder_.dissolve_groups(std::move(dissolved));
}

bool BroadPhase::covers(const VecX& x) const {
  if (builds_ == 0 || x.size() != 3 * static_cast<Eigen::Index>(safe_boxes_.size())) return false;
  return all_of(mesh_.vertices, [&](int v) { return safe_boxes_[v].contains(vertex(x, v)); });
}

Aabb BroadPhase::box_of(const Triangle& triangle) const {
  Aabb box;
  for (const int v : triangle) box.include(safe_boxes_[v]);
  return box;
}

Aabb BroadPhase::box_of(const Triangle& triangle, const Vec3& inside) const {
  Aabb box;
  box.lo = box.hi = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    box.lo += inside[i] * safe_boxes_[triangle[i]].lo;
    box.hi += inside[i] * safe_boxes_[triangle[i]].hi;
  }
  return box;
}

// Half of the range, and rounding.
void BroadPhase::reach_out(int object, Aabb& box) const {
  const double reach = reaches_.surface[object];
  box.inflate(reach + 4.0 * std::numeric_limits<double>::epsilon() * (box.hi.cwiseAbs().maxCoeff() + 2 * reach));
}

void BroadPhase::triangles_near(const Triangle& triangle, const Vec3& inside, std::vector<int>& out) const {
  Aabb box = box_of(triangle, inside);
  reach_out(mesh_.vertex_object[triangle[0]], box);
  finder_.triangles_in(box, -1, out);
}

void BroadPhase::triangles_near(const Triangle& triangle, const Vec3& inside, std::span<const int> among, std::vector<int>& out) const {
  Aabb box = box_of(triangle, inside);
  reach_out(mesh_.vertex_object[triangle[0]], box);
  for (const int t : among) {
    Aabb other = box_of(mesh_.triangles[t]);
    other.inflate(inflation_.surface[mesh_.vertex_object[mesh_.triangles[t][0]]]);
    if (other.overlaps(box)) out.push_back(t);
  }
}

void BroadPhase::others_near(const Triangle& triangle, std::vector<int>& out) const {
  const int object = mesh_.vertex_object[triangle[0]];
  Aabb box = box_of(triangle);
  reach_out(object, box);
  finder_.triangles_in(box, object, out);
}

void BroadPhase::check(const VecX& x, const VecX& p, const Reaches& reaches, double skin) const {
  const auto size = 3 * static_cast<Eigen::Index>(mesh_.vertex_object.size());
  if (x.size() != size || (p.size() != 0 && p.size() != size))
    throw InputError(fmt::format(
        "broad phase: x has {} and p {} coordinates; the mesh has {} (3 a vertex; p may be empty)",
        x.size(), p.size(), size));
  if (!(skin >= 0.0)) throw InputError(fmt::format("broad phase: a skin of {} m must not be negative", skin));
  for (const auto* lengths : {&reaches.surface, &reaches.edge}) {
    if (static_cast<int>(lengths->size()) < objects_)
      throw InputError(fmt::format("broad phase: reaches of {} objects; the mesh has {}", lengths->size(), objects_));
    for (const double length : *lengths)
      if (!(length >= 0.0)) throw InputError(fmt::format("broad phase: a reach of {} m must not be negative", length));
  }
  check_finite(x, "the position");
  check_finite(p, "the displacement");
}

std::vector<Aabb> BroadPhase::boxes_around(const VecX& x, const VecX& p, double inflation) const {
  std::vector<Aabb> boxes(mesh_.vertex_object.size());
  for_each(static_cast<int>(mesh_.vertices.size()), [&](int i) {
    const int v = mesh_.vertices[i];
    Aabb box;
    box.include(Vec3(vertex(x, v)));
    if (p.size() != 0) box.include(Vec3(vertex(x, v) + vertex(p, v)));
    box.inflate(inflation);
    boxes[v] = box;
  }, kGrain);
  return boxes;
}

}  // namespace tack
