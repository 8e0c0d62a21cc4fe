// Lower bounds of the distances of candidates while their vertices stay in given AABBs.
//
// Key idea: the distance of two convex hulls changes by no more than their vertices move. With the
// distance d at the centres of the AABBs and the largest half diagonals r_a, r_b of the vertices'
// AABBs,
//   distance >= d - r_a - r_b.
// d is the *reference distance*, and the centres are the reference positions (candidates.hpp).
#pragma once

#include <vector>

#include "geometry/broad_phase/aabb.hpp"
#include "geometry/broad_phase/candidates.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// Sets reference positions, reference distances and distance bounds of all candidates.
// vertex_boxes: per global vertex; those of surface vertices are finite.
void find_distance_bounds(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes,
                          Candidates& candidates);

// Sets reference distances and distance bounds of new candidates alone. All others are pairs of
// objects without a flag in `changed` (per object) and keep theirs.
void find_new_distance_bounds(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes,
                              const std::vector<char>& changed,
                              const CandidateIndices& new_candidates, Candidates& candidates);

// Sets the reference positions to x (3 coordinates per global vertex [m]) and the reference
// distances there.
void find_reference_distances(const CollisionMesh& mesh, const VecX& x, Candidates& candidates);

}  // namespace tack
