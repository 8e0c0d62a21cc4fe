// The mesh of a body as one of its own.
#pragma once

#include "framework/scene/body.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// In local vertex indices, with the positions of `rest` (3n); a solid's triangles are those of its tets.
Mesh local_mesh(const Body& body, const VecX& rest);

}  // namespace tack
