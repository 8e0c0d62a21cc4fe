// Collision candidates that stay valid while vertices move a little.
//
// Key idea: when candidates are built, each vertex v gets a *fat AABB*
//   B_v = box(x_v, x_v + p_v) inflated by skin / 2        (a Verlet skin).
// The AABB of a primitive is the union of the fat AABBs of its vertices, inflated by the inflation
// radius of its object. Candidates are all pairs of primitives whose AABBs overlap.
//
// Invariant: while every vertex stays in its fat AABB, every pair that is closer than the sum of
// both inflation radii is a candidate. A primitive whose vertices lie in their fat AABBs lies in
// its own, by convexity; so the invariant holds during minimisation, line search and CCD alike. All
// boxes are a few rounding errors larger, so that it holds in floating point.
//
// Rebuild policy:
//   1. If few objects have left their fat AABBs, only their pairs are searched again.
//   2. Each candidate stores a lower bound of its distance (distance_bounds.hpp), valid inside the
//      fat AABBs, so that most candidates are skipped without a distance computation.
//   3. If vertices hardly move for a number of updates, *tight AABBs* replace the fat ones in these
//      bounds, until a vertex leaves its tight AABB.
//   4. Reference distances are those at the centres of the boxes. They are computed again where
//      vertices have come to rest far from there.
#pragma once

#include <span>
#include <vector>

#include "geometry/broad_phase/candidate_finder.hpp"

namespace tack {

class BroadPhase {
 public:
  // The mesh must outlive the broad phase and not change.
  BroadPhase(const CollisionMesh& mesh, CollidingObjects colliding);

  // Rebuilds the candidates if a surface vertex of x or x + p lies outside its fat AABB, or if an
  // inflation radius has grown since the last build. Returns true if candidates or distance bounds
  // have changed.
  // x [m]: 3 coordinates per global vertex; p [m]: the same, or empty (zero); skin [m].
  // Throws InputError for wrong sizes or a negative radius or skin, SimulationError for a
  // coordinate that is not finite.
  bool update(const VecX& x, const VecX& p, const InflationRadii& radii, double skin);
  // Inflates all objects equally: candidates are pairs within `range` [m].
  bool update(const VecX& x, const VecX& p, double range, double skin) {
    return update(x, p, InflationRadii::uniform(mesh_, range, range), skin);
  }

  // Returns whether every surface vertex lies inside its fat AABB; false before the first build.
  bool covers(const VecX& x) const;
  // The same for some of the vertices.
  bool covers(const VecX& x, std::span<const int> vertices) const;
  // Whether a vertex would lie in its fat AABB at this position [m].
  bool covers(int vertex, const Vec3& position) const;

  const Candidates& candidates() const { return candidates_; }
  // Appends, ascending, the triangles that may come within range of a point of the triangle while
  // vertices stay in their fat AABBs. triangle: global vertices; inside: barycentric coordinates.
  void triangles_near(const Triangle& triangle, const Vec3& inside, std::vector<int>& out) const;
  // Restricts that search to the triangles in `among`.
  void triangles_near(const Triangle& triangle, const Vec3& inside, std::span<const int> among,
                      std::vector<int>& out) const;
  // Appends, ascending, the triangles that may come within range of any point of the triangle,
  // without those of its rigid group, unless own pairs of that group are searched.
  void triangles_near(const Triangle& triangle, std::vector<int>& out) const;
  // Appends, ascending, those of them that are of other objects.
  void others_near(const Triangle& triangle, std::vector<int>& out) const;
  // Returns the primitives whose pairs and distance bounds changed in the last update that returned
  // true; null if all may have changed.
  const ChangedPrimitives* changed() const { return partial_ ? &finder_.changed() : nullptr; }
  // Returns the number of candidate builds so far.
  int builds() const { return builds_; }

 private:
  void check(const VecX& x, const VecX& p, const InflationRadii& radii, double skin) const;
  std::vector<Aabb> boxes_around(const VecX& x, const VecX& p, double inflation) const;
  void pad_radii(double rounding);
  bool inside(const std::vector<Aabb>& boxes, const VecX& x, const VecX& p) const;
  Aabb box_of(const Triangle& triangle) const;
  Aabb box_of(const Triangle& triangle, const Vec3& inside) const;
  void inflate_query(int object, Aabb& box) const;
  void update_reference_distances(const VecX& x, const VecX& p);
  bool update_distance_bounds(const VecX& x, const VecX& p, double skin);
  std::vector<char> objects_outside(const VecX& x, const VecX& p) const;

  const CollisionMesh& mesh_;
  int objects_;
  CandidateFinder finder_;
  std::vector<Aabb> fat_boxes_;    // per global vertex; empty boxes for interior vertices
  std::vector<Aabb> tight_boxes_;  // per global vertex; empty vector: bounds hold in the fat boxes
  Candidates candidates_;
  int updates_since_bounds_ = 0;  // updates since the distance bounds were computed
  int tighten_after_ = 16;        // updates before boxes are tightened
  InflationRadii radii_;          // of the last build
  InflationRadii padded_radii_;   // radii_ plus rounding errors
  int builds_ = 0;
  bool stale_ = false;    // candidates lack pairs of rigid groups that were enabled since
  bool partial_ = false;  // the last build replaced only pairs of some objects
};

}  // namespace tack
