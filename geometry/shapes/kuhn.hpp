// Structured block from which solid shapes are mapped: the cube [-1, 1]^3 cut into cells[0] x
// cells[1] x cells[2] cells of six tets each (Kuhn 1960, Freudenthal 1942). There is one tet per
// order of the axes: its path goes along the axes from one corner of the cell to the opposite
// corner.
// Node (i, j, k) is vertex i + (nx+1) (j + (ny+1) k). Cells are in the same order, x fastest.
// All six tets share the diagonal from corner (0,0,0) to (1,1,1) of the cell. Along a
// mirrored axis, the cells below 0 are mirror images of those above, so that diagonals point away
// from the centre. In both cases neighbours conform and every tet is positive.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns the block. cells: at least 1, even along a mirrored axis. Throws InputError, beginning
// with `shape`.
Mesh kuhn_cube(const char* shape, const std::array<int, 3>& cells,
               const std::array<bool, 3>& mirrored);

}  // namespace tack
