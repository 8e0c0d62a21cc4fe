// The mesh of a body as one of its own.
#pragma once

#include "framework/body/body.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// In local vertex indices, with the positions of `rest` (3n); its triangles are those of its sheets.
Mesh local_mesh(const Body& body, const VecX& rest);

}  // namespace tack
