// Division of prisms into tets.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Adds the tets of the prism between two triangles; corner i of one is joined to corner i of the
// other. Sides are cut from the first to the second of their corners, so that prisms that share a
// side conform if both list its corners in the same order. If the triangles share a corner, the
// prism degenerates to fewer tets. Tets are positive.
void add_prism(Mesh& mesh, const std::array<int, 3>& one, const std::array<int, 3>& other);

}  // namespace tack
