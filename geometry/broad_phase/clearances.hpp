// The clearances of candidates whose vertices stay in their safe boxes (broad_phase.hpp), and their distances at the
// centres of these.
//
// Key idea: the distance of two convex hulls changes by no more than their vertices move. So it never falls below
// that at the centres of the safe boxes by more than the largest half diagonals of both sides.
#pragma once

#include <vector>

#include "geometry/broad_phase/aabb.hpp"
#include "geometry/broad_phase/candidates.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// Sets them for the lists of candidates. vertex_boxes: by global vertex; those of surface vertices are finite.
void find_clearances(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, Candidates& candidates);

// The same for the fresh ones. Others, which touch none of the objects whose boxes have changed (a flag for each), keep theirs.
void find_fresh_clearances(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, const std::vector<char>& changed, const SomeCandidates& fresh,
                           Candidates& candidates);

// Sets their distances, where vertices are at x (3 coordinates for every global vertex [m]).
void find_distances(const CollisionMesh& mesh, const VecX& x, Candidates& candidates);

}  // namespace tack
