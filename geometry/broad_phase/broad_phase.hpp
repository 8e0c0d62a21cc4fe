// Which primitives may touch while the vertices move a little: candidates kept over many
// evaluations.
//
// Key idea: when candidates are built, each vertex v gets a *safe box*
//   B_v = box(x_v, x_v + p_v) inflated by skin/2.
// Candidates are all pairs whose primitive boxes (the union of the safe boxes of their vertices),
// inflated by the reach of their object each, overlap. A primitive whose vertices lie in their safe boxes lies in its
// primitive box, by convexity; hence, as long as every vertex lies in its safe box, every pair
// closer than the reaches of both is among the candidates, during minimisation, line search and CCD alike. (All
// boxes are a few rounding errors larger than said, so that this holds in floating point.)
// Where only few objects have left their safe boxes, those alone get new ones and are searched; what is known of other pairs stays.
// Most candidates are far apart all the same, so each has a clearance (clearances.hpp). It holds in the safe boxes,
// or, where vertices hardly moved for a while, in much smaller ones, and is found anew when a vertex leaves those. Their distances are those in the middle of these
// boxes, and found anew where vertices have come to rest far from there.
#pragma once

#include <span>
#include <vector>

#include "geometry/broad_phase/candidate_finder.hpp"

namespace tack {

class BroadPhase {
 public:
  // The mesh must outlive the broad phase and not change.
  BroadPhase(const CollisionMesh& mesh, CollidingObjects colliding);

  // Rebuilds if some surface vertex of x or x + p lies outside its safe box, or if a reach grew since
  // the last build. x [m] holds 3 coordinates for every global vertex; p [m] too, or it is empty
  // (zero). skin: [m]. Returns true if rebuilt, or if clearances were found anew. Throws InputError for wrong sizes or a
  // negative reach or skin, SimulationError if a coordinate is not finite.
  bool update(const VecX& x, const VecX& p, const Reaches& reaches, double skin);
  // The same reach for all objects: pairs within `range`.
  bool update(const VecX& x, const VecX& p, double range, double skin) {
    return update(x, p, Reaches::uniform(mesh_, range, range), skin);
  }

  // Pairs of the rigid groups of these vertices (global; empty: of none) are searched too: for when they move against each other.
  void dissolve_groups_of(const std::vector<int>& vertices);

  // Whether every surface vertex lies inside its safe box; false before the first build.
  bool covers(const VecX& x) const;

  const Candidates& candidates() const { return candidates_; }
  // Appends the triangles that may come within range of a point inside the triangle of these vertices (global),
  // given by its barycentric coordinates, while vertices stay in their safe boxes; ascending.
  void triangles_near(const Triangle& triangle, const Vec3& inside, std::vector<int>& out) const;
  // The same among these.
  void triangles_near(const Triangle& triangle, const Vec3& inside, std::span<const int> among, std::vector<int>& out) const;
  // The same of any of its points, without those of its own object.
  void others_near(const Triangle& triangle, std::vector<int>& out) const;
  // Of the last update that returned true: pairs of others, and their clearances, are what they were before. Null: all may be new.
  const ChangedPrimitives* changed() const { return partly_ ? &finder_.changed() : nullptr; }
  // The number of candidate builds so far.
  int builds() const { return builds_; }

 private:
  void check(const VecX& x, const VecX& p, const Reaches& reaches, double skin) const;
  std::vector<Aabb> boxes_around(const VecX& x, const VecX& p, double inflation) const;
  void inflate_reaches(double rounding);
  bool inside(const std::vector<Aabb>& boxes, const VecX& x, const VecX& p) const;
  Aabb box_of(const Triangle& triangle) const;
  Aabb box_of(const Triangle& triangle, const Vec3& inside) const;
  void reach_out(int object, Aabb& box) const;
  void renew_distances(const VecX& x, const VecX& p);
  bool renew_clearances(const VecX& x, const VecX& p, double skin);
  std::vector<char> strayed(const VecX& x, const VecX& p) const;

  const CollisionMesh& mesh_;
  int objects_;
  CandidateFinder finder_;
  std::vector<Aabb> safe_boxes_;  // by global vertex; empty boxes for interior vertices
  std::vector<Aabb> tight_boxes_;  // likewise, in which clearances hold; empty: they hold in the safe boxes
  Candidates candidates_;
  int served_ = 0;     // updates since clearances were found
  int patience_ = 16;  // updates before boxes are tightened
  Reaches reaches_;    // of the last build
  Reaches inflation_;  // of primitives' boxes: the same, and rounding
  int builds_ = 0;
  bool stale_ = false;   // the candidates are not those that are wanted
  bool partly_ = false;  // only some are new
};

}  // namespace tack
