// Exact self-intersection test of surfaces (CGAL's exact predicates on double coordinates). It does
// not depend on the collision detection of the solver, and therefore can verify it.
//
// Two triangulated surfaces intersect if and only if an edge of one meets a triangle of the other.
// Touching counts. Pairs that share a vertex are skipped. Degenerate triangles and edges are
// treated as segments or points.
#pragma once

#include <vector>

#include "geometry/broad_phase/colliding_objects.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

struct EdgeTriangleHit {
  int edge, triangle;  // indices into the collision mesh
  friend bool operator==(const EdgeTriangleHit&, const EdgeTriangleHit&) = default;
};

// Returns the first `max_hits` intersecting pairs, sorted by edge, then triangle. x [m]: 3
// coordinates for every global vertex. movable_only: pairs without a movable vertex are skipped.
// Throws SimulationError if a coordinate is not finite, InputError if x is too short.
std::vector<EdgeTriangleHit> find_intersections(const CollisionMesh& mesh, const VecX& x,
                                                const CollidingObjects& colliding, int max_hits,
                                                bool movable_only = true);

}  // namespace tack
