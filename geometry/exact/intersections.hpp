// Does a surface intersect itself? Exact answers (CGAL's exact predicates on the double
// coordinates), independent of the solver's own collision detection, so that it can be trusted to
// verify the solver.
//
// Two triangulated surfaces intersect exactly if an edge of one meets a triangle of the other.
// Closed sets: touching counts. Pairs that share a vertex are skipped. Degenerate triangles and
// edges are treated as the segments or points they are.
#pragma once

#include <vector>

#include "geometry/broad_phase/colliding_objects.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

struct EdgeTriangleHit {
  int edge, triangle;  // indices into the collision mesh
  friend bool operator==(const EdgeTriangleHit&, const EdgeTriangleHit&) = default;
};

// The first `max_hits` intersecting pairs, sorted by edge, then triangle. x [m]: 3 coordinates for
// every global vertex. With `movable_only`, pairs in which no vertex is movable are skipped. Throws
// SimulationError if a coordinate of x is not finite, InputError if x is too short.
std::vector<EdgeTriangleHit> find_intersections(const CollisionMesh& mesh, const VecX& x,
                                                const CollidingObjects& colliding, int max_hits,
                                                bool movable_only = true);

}  // namespace tack
