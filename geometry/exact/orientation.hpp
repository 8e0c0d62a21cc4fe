// Exact sign of the volume of tetrahedra (CGAL's exact predicates on the double coordinates).
// Positive: (b - a) x (c - a) . (d - a) > 0 for the vertices a, b, c, d.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

// The lowest index of a tetrahedron whose volume is not positive (inverted or exactly flat), or -1.
// x [m]: 3 coordinates for every global vertex. A coordinate that is not finite makes its
// tetrahedra count as inverted.
int first_inverted_tet(const std::vector<Tet>& tets, const VecX& x);

// Returns whether a point lies in a closed tetrahedron of positive volume.
bool tet_contains(const Tet& tet, const VecX& x, const Vec3& point);

}  // namespace tack
