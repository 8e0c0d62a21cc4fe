// Triangles as flat as a line, mended by turning their longest edge.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Of a closed surface, each triangle that is lower than `height` [m] gives its longest edge for the other diagonal of the two
// triangles beside it, where the lower one of the two that result is higher. Vertices stay; returns how many edges turned.
int flip_slivers(Mesh& mesh, double height);

}  // namespace tack
