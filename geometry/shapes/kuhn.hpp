// The structured block that the solid shapes are mapped from: the cube [-1, 1]^3 cut into
// cells[0] x cells[1] x cells[2] cells of six tets each (Kuhn 1960, Freudenthal 1942): one tet per
// order of the axes, walking from one corner of the cell along the axes to the opposite corner.
// Node (i, j, k) is vertex i + (nx+1) (j + (ny+1) k). Cells run in the same order, x fastest.
// All six tets share the diagonal from corner (0,0,0) to (1,1,1) of the cell; along a mirrored axis
// the cells below 0 are the mirror images of those above, so that diagonals point away from the
// centre. Either way neighbours conform and every tet is positive.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// cells >= 1, even along a mirrored axis; `shape` names the caller's shape in errors (InputError).
Mesh kuhn_cube(const char* shape, const std::array<int, 3>& cells,
               const std::array<bool, 3>& mirrored);

}  // namespace tack
