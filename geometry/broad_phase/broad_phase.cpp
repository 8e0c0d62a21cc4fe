#include "geometry/broad_phase/broad_phase.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/broad_phase/distance_bounds.hpp"
#include "geometry/errors.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int vertices_per_task = 1024;
constexpr double partial_search_fraction_max = 0.4;  // of vertices outside their boxes: above it, all pairs are searched
constexpr double tight_margin_per_skin = 0.05;       // inflation of tight boxes over the skin

template <class Predicate>
bool all_of(const std::vector<int>& vertices, const Predicate& predicate) {
  std::atomic<bool> all = true;
  for_each_chunk(static_cast<int>(vertices.size()), [&](int, int first, int last) {
    if (all.load(std::memory_order_relaxed) && !std::all_of(vertices.begin() + first, vertices.begin() + last, predicate))
      all.store(false, std::memory_order_relaxed);
  }, vertices_per_task);
  return all;
}

// Returns the largest absolute value, 0 for an empty vector.
double largest(const VecX& values) {
  return max_chunks(static_cast<int>(values.size()), 0.0, [&](int first, int last) {
    double bound = 0.0;
    for (int i = first; i < last; ++i) bound = std::max(bound, std::abs(values[i]));
    return bound;
  }, 3 * vertices_per_task);
}

// Returns the largest absolute difference of two vectors.
double largest_difference(const VecX& a, const VecX& b) {
  return max_chunks(static_cast<int>(a.size()), 0.0, [&](int first, int last) {
    double bound = 0.0;
    for (int i = first; i < last; ++i) bound = std::max(bound, std::abs(a[i] - b[i]));
    return bound;
  }, 3 * vertices_per_task);
}

void check_finite(const VecX& values, const char* name) {
  const double not_finite = sum_chunks(static_cast<int>(values.size()), [&](int first, int last) {
    return values.segment(first, last - first).allFinite() ? 0.0 : 1.0;
  }, 3 * vertices_per_task);
  if (not_finite == 0) return;
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

bool BroadPhase::update(const VecX& x, const VecX& p, const InflationRadii& radii, double skin) {
  check(x, p, radii, skin);
  const bool known = builds_ > 0 && !stale_ && radii.within(radii_);
  if (known && inside(fat_boxes_, x, p)) return update_distance_bounds(x, p, skin) || (update_reference_distances(x, p), false);

  std::vector<char> changed;
  if (known) changed = objects_outside(x, p);
  if (changed.empty()) radii_ = radii;  // else the other candidates keep theirs
  const double size = largest(x) + largest(p) + radii_.largest_range() + skin;
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * size;
  pad_radii(rounding);
  std::vector<Aabb> boxes = boxes_around(x, p, 0.5 * skin + rounding);
  if (changed.empty()) {
    fat_boxes_ = std::move(boxes);
    finder_.find(fat_boxes_, padded_radii_, candidates_);
    find_distance_bounds(mesh_, fat_boxes_, candidates_);
  } else {
    for_each(static_cast<int>(mesh_.vertices.size()), [&](int i) {
      const int v = mesh_.vertices[i];
      if (changed[mesh_.vertex_object[v]]) fat_boxes_[v] = boxes[v];
    }, vertices_per_task);
    finder_.find_changed(fat_boxes_, padded_radii_, changed, candidates_);
    if (tight_boxes_.empty()) find_new_distance_bounds(mesh_, fat_boxes_, changed, finder_.new_candidates(), candidates_);
    else find_distance_bounds(mesh_, fat_boxes_, candidates_);
  }
  candidates_.groups.make(candidates_, mesh_);
  partial_ = !changed.empty() && tight_boxes_.empty();
  tight_boxes_.clear();
  updates_since_bounds_ = 0;
  stale_ = false;
  ++builds_;
  return true;
}

void BroadPhase::pad_radii(double rounding) {
  padded_radii_ = radii_;
  for (double& radius : padded_radii_.surface) radius += rounding;
  for (double& radius : padded_radii_.edge) radius += rounding;
}

// Returns a flag per object that has left its fat boxes; empty if all pairs should be searched: if
// these objects have too many of the vertices, or one of them has a fixed vertex.
std::vector<char> BroadPhase::objects_outside(const VecX& x, const VecX& p) const {
  std::vector<char> objects(objects_, 0), fixed(objects_, 0);
  std::vector<int> size(objects_, 0);
  for (const int v : mesh_.vertices) {
    const int object = mesh_.vertex_object[v];
    ++size[object];
    fixed[object] |= !mesh_.vertex_movable[v];
    if (objects[object]) continue;
    const Aabb& box = fat_boxes_[v];
    if (box.contains(vertex(x, v)) && (p.size() == 0 || box.contains(vertex(x, v) + vertex(p, v)))) continue;
    objects[object] = 1;
  }
  int vertices_outside = 0;
  for (int i = 0; i < objects_; ++i) {
    if (!objects[i]) continue;
    if (fixed[i]) return {};
    vertices_outside += size[i];
  }
  if (vertices_outside > partial_search_fraction_max * static_cast<double>(mesh_.vertices.size())) return {};
  return objects;
}

// Computes reference distances again where vertices have come to rest far from the reference.
void BroadPhase::update_reference_distances(const VecX& x, const VecX& p) {
  if (largest(p) > 0 || largest_difference(x, candidates_.reference) < radii_.largest_range()) return;
  find_reference_distances(mesh_, x, candidates_);
}

// Tightens the boxes of the distance bounds after tighten_after_ updates; quadruples that number if a vertex leaves its tight box
// sooner.
bool BroadPhase::update_distance_bounds(const VecX& x, const VecX& p, double skin) {
  const double margin = tight_margin_per_skin * skin;
  const bool tighten = ++updates_since_bounds_ >= tighten_after_ && largest(p) <= margin;
  if (tight_boxes_.empty() ? !tighten : inside(tight_boxes_, x, p)) return false;
  if (!tight_boxes_.empty() && !tighten) tighten_after_ *= 4;
  tight_boxes_.clear();
  if (tighten) tight_boxes_ = boxes_around(x, p, margin);
  find_distance_bounds(mesh_, tight_boxes_.empty() ? fat_boxes_ : tight_boxes_, candidates_);
  partial_ = false;
  updates_since_bounds_ = 0;
  return true;
}

bool BroadPhase::inside(const std::vector<Aabb>& boxes, const VecX& x, const VecX& p) const {
  const auto inside = [&](int v) {
    return boxes[v].contains(vertex(x, v)) && (p.size() == 0 || boxes[v].contains(vertex(x, v) + vertex(p, v)));
  };
  return all_of(mesh_.vertices, inside);
}

bool BroadPhase::covers(const VecX& x) const {
  if (builds_ == 0 || x.size() != 3 * static_cast<Eigen::Index>(fat_boxes_.size())) return false;
  return all_of(mesh_.vertices, [&](int v) { return fat_boxes_[v].contains(vertex(x, v)); });
}

bool BroadPhase::covers(const VecX& x, std::span<const int> vertices) const {
  if (builds_ == 0 || x.size() != 3 * static_cast<Eigen::Index>(fat_boxes_.size())) return false;
  return std::all_of(vertices.begin(), vertices.end(), [&](int v) { return covers(v, vertex(x, v)); });
}

// Interior vertices have empty boxes, which bound nothing.
bool BroadPhase::covers(int v, const Vec3& position) const {
  const Aabb& box = fat_boxes_[v];
  return box.lo.x() > box.hi.x() || box.contains(position);
}

Aabb BroadPhase::box_of(const Triangle& triangle) const {
  Aabb box;
  for (const int v : triangle) box.include(fat_boxes_[v]);
  return box;
}

Aabb BroadPhase::box_of(const Triangle& triangle, const Vec3& inside) const {
  Aabb box;
  box.lo = box.hi = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    box.lo += inside[i] * fat_boxes_[triangle[i]].lo;
    box.hi += inside[i] * fat_boxes_[triangle[i]].hi;
  }
  return box;
}

// Inflates by the radius of the object plus rounding errors.
void BroadPhase::inflate_query(int object, Aabb& box) const {
  const double radius = radii_.surface[object];
  box.inflate(radius + 4.0 * std::numeric_limits<double>::epsilon() * (box.hi.cwiseAbs().maxCoeff() + 2 * radius));
}

void BroadPhase::triangles_near(const Triangle& triangle, const Vec3& inside, std::vector<int>& out) const {
  Aabb box = box_of(triangle, inside);
  inflate_query(mesh_.vertex_object[triangle[0]], box);
  finder_.triangles_in(box, -1, -1, out);
}

void BroadPhase::triangles_near(const Triangle& triangle, const Vec3& inside, std::span<const int> among, std::vector<int>& out) const {
  Aabb box = box_of(triangle, inside);
  inflate_query(mesh_.vertex_object[triangle[0]], box);
  for (const int t : among) {
    Aabb other = box_of(mesh_.triangles[t]);
    other.inflate(padded_radii_.surface[mesh_.vertex_object[mesh_.triangles[t][0]]]);
    if (other.overlaps(box)) out.push_back(t);
  }
}

void BroadPhase::triangles_near(const Triangle& triangle, std::vector<int>& out) const {
  Aabb box = box_of(triangle);
  inflate_query(mesh_.vertex_object[triangle[0]], box);
  int group = mesh_.vertex_group.empty() ? -1 : mesh_.vertex_group[triangle[0]];
  for (const int v : triangle)
    if (group >= 0 && mesh_.vertex_group[v] != group) group = -1;
  finder_.triangles_in(box, -1, group, out);
}

void BroadPhase::others_near(const Triangle& triangle, std::vector<int>& out) const {
  const int object = mesh_.vertex_object[triangle[0]];
  Aabb box = box_of(triangle);
  inflate_query(object, box);
  finder_.triangles_in(box, object, -1, out);
}

void BroadPhase::check(const VecX& x, const VecX& p, const InflationRadii& radii, double skin) const {
  const auto size = 3 * static_cast<Eigen::Index>(mesh_.vertex_object.size());
  if (x.size() != size || (p.size() != 0 && p.size() != size))
    throw InputError(fmt::format(
        "broad phase: x has {} and p {} coordinates; the mesh has {} (3 a vertex; p may be empty)",
        x.size(), p.size(), size));
  if (!(skin >= 0.0)) throw InputError(fmt::format("broad phase: a skin of {} m must not be negative", skin));
  for (const auto* lengths : {&radii.surface, &radii.edge}) {
    if (static_cast<int>(lengths->size()) < objects_)
      throw InputError(fmt::format("broad phase: inflation radii of {} objects; the mesh has {}", lengths->size(), objects_));
    for (const double length : *lengths)
      if (!(length >= 0.0)) throw InputError(fmt::format("broad phase: an inflation radius of {} m must not be negative", length));
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
  }, vertices_per_task);
  return boxes;
}

}  // namespace tack
