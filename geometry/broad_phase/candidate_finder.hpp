// Candidate search of the broad phase: one bounding volume hierarchy per kind of primitive.
#pragma once

#include <vector>

#include "geometry/broad_phase/candidate_kinds.hpp"
#include "geometry/broad_phase/candidates.hpp"
#include "geometry/broad_phase/changed_primitives.hpp"
#include "geometry/broad_phase/colliding_objects.hpp"
#include "geometry/broad_phase/primitives.hpp"
#include "geometry/broad_phase/inflation_radii.hpp"
#include "geometry/broad_phase/nearby_objects.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// Keeps the trees between searches.
class CandidateFinder {
 public:
  CandidateFinder(const CollisionMesh& mesh, CollidingObjects colliding);

  // Finds all pairs whose boxes overlap. The box of a primitive is the union of its vertices' boxes
  // (per global id; finite and not empty for surface vertices), inflated by the radius of its
  // object.
  void find(const std::vector<Aabb>& vertex_boxes, const InflationRadii& radii,
            Candidates& candidates);
  // Finds pairs again where only the boxes of movable objects with a flag in `changed` (per object)
  // have changed since `candidates` were found. Other pairs keep their distance bounds and
  // reference distances; those of new_candidates() are not set.
  void find_changed(const std::vector<Aabb>& vertex_boxes, const InflationRadii& radii,
                    const std::vector<char>& changed, Candidates& candidates);

  // The primitives of the last find_changed, and the candidates that it added.
  const ChangedPrimitives& changed() const { return changed_; }
  const CandidateIndices& new_candidates() const { return new_candidates_; }

  // Appends, ascending, the triangles whose boxes of the last search overlap this box, without
  // those of the object `without` and of the rigid group `without_group` (-1: none).
  void triangles_in(const Aabb& box, int without, int without_group, std::vector<int>& out) const;

 private:
  void search(const std::vector<Aabb>& vertex_boxes, const InflationRadii& radii,
              const std::vector<char>& active_objects, Candidates& candidates);
  template <SearchedPrimitives searched>
  const auto& primitives() const;

  const CollisionMesh& mesh_;
  CollidingObjects colliding_;
  Primitives<1> points_, codim_points_;
  Primitives<2> edges_, codim_edges_;
  Primitives<3> triangles_;
  NearbyObjects nearby_;
  ChangedPrimitives changed_;          // of the last find_changed
  CandidateIndices new_candidates_;    // of the last find_changed
  Candidates changed_pairs_, merged_;  // its pairs of changed objects; buffer for the merged lists
};

}  // namespace tack
