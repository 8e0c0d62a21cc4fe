// Exact sign of the volume of tetrahedra (CGAL's exact predicates on the double coordinates).
// Positive: (b - a) x (c - a) . (d - a) > 0 for the vertices a, b, c, d.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

// Returns the lowest index of a tetrahedron whose volume is not positive (inverted or exactly
// flat); -1: none. x [m]: 3 coordinates for every global vertex. Tetrahedra with a coordinate that
// is not finite count as inverted.
int first_inverted_tet(const std::vector<Tet>& tets, const VecX& x);

// Returns true if a point is in a closed tetrahedron of positive volume.
bool tet_contains(const Tet& tet, const VecX& x, const Vec3& point);

}  // namespace tack
