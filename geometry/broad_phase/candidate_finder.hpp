// The broad phase's search for candidates.
#pragma once

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/broad_phase/colliding_objects.hpp"
#include "geometry/broad_phase/primitives.hpp"
#include "geometry/broad_phase/reaches.hpp"
#include "geometry/broad_phase/rivals.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// Keeps one tree per kind of primitive between searches.
class CandidateFinder {
 public:
  CandidateFinder(const CollisionMesh& mesh, CollidingObjects colliding);

  // All pairs whose boxes overlap: a primitive's box is the union of its vertices' boxes (by global
  // id; finite and not empty for surface vertices), inflated by the reach of its object.
  void find(const std::vector<Aabb>& vertex_boxes, const Reaches& reaches, Candidates& candidates);
  // The same where the boxes of these movable objects alone (a flag for each) have changed since `candidates` were found, with their clearances and
  // distances: other pairs keep those, new ones have the distance `unknown_length`, and none of their clearances is known.
  void find_again(const std::vector<Aabb>& vertex_boxes, const Reaches& reaches, const std::vector<char>& changed, Candidates& candidates);
  // Whether pairs of one rigid group are searched too.
  void dissolve_groups(bool dissolved) { dissolved_ = dissolved; }

  // Appends the triangles, but those of one object (-1: of all), whose boxes overlap this one, by the boxes of the last search; ascending.
  void triangles_in(const Aabb& box, int without, std::vector<int>& out) const;

 private:
  void search(const std::vector<Aabb>& vertex_boxes, const Reaches& reaches, const std::vector<char>& active_objects, Candidates& candidates);

  const CollisionMesh& mesh_;
  CollidingObjects colliding_;
  bool dissolved_ = false;
  Primitives<1> points_, codim_points_;
  Primitives<2> edges_, codim_edges_;
  Primitives<3> triangles_;
  Rivals rivals_;
};

}  // namespace tack
