// Prisms between two triangles, cut into tets.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Corner i of one triangle belongs to corner i of the other. Sides are cut from the first to the
// second of their corners: prisms that share a side conform if both name its corners in the same
// order. If both triangles share a corner, the prism degenerates to fewer tets. Tets are positive.
void add_prism(Mesh& mesh, const std::array<int, 3>& one, const std::array<int, 3>& other);

}  // namespace tack
