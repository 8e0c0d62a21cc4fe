// Mesh of a single body.
#pragma once

#include "framework/body/body.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns the mesh in local vertex indices, with the positions of `rest` (3n). Its triangles are
// those of the sheets of the body.
Mesh local_mesh(const Body& body, const VecX& rest);

}  // namespace tack
