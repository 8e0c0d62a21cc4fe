// The broad phase's search for candidates.
#pragma once

#include <utility>
#include <vector>

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/broad_phase/changed_primitives.hpp"
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
  // distances: other pairs keep those; of `fresh` ones they are not known.
  void find_again(const std::vector<Aabb>& vertex_boxes, const Reaches& reaches, const std::vector<char>& changed, Candidates& candidates);
  // The rigid groups whose own pairs are searched too: a flag for each, or empty (none). Returns whether they were others before.
  bool dissolve_groups(std::vector<char> dissolved) { return std::exchange(dissolved_, std::move(dissolved)) != dissolved_; }

  // What the last find_again was told, and what it found.
  const ChangedPrimitives& changed() const { return changed_; }
  const SomeCandidates& fresh() const { return fresh_; }

  // Appends the triangles, but those of one object (-1: of all), whose boxes overlap this one, by the boxes of the last search; ascending.
  void triangles_in(const Aabb& box, int without, std::vector<int>& out) const;

 private:
  void search(const std::vector<Aabb>& vertex_boxes, const Reaches& reaches, const std::vector<char>& active_objects, Candidates& candidates);

  const CollisionMesh& mesh_;
  CollidingObjects colliding_;
  std::vector<char> dissolved_;
  Primitives<1> points_, codim_points_;
  Primitives<2> edges_, codim_edges_;
  Primitives<3> triangles_;
  Rivals rivals_;
  ChangedPrimitives changed_;  // of the last search again
  SomeCandidates fresh_;       // likewise
  Candidates found_, merged_;  // its pairs of what changed; memory for all
};

}  // namespace tack
