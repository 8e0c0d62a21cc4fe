// Repair of nearly degenerate triangles by flipping their longest edge.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Flips the longest edge of each triangle of a closed surface that is lower than `height` [m], if
// the lower one of the two resulting triangles is higher. Vertices stay. Returns the number of
// flipped edges.
int flip_slivers(Mesh& mesh, double height);

}  // namespace tack
