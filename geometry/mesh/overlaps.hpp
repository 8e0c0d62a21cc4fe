// Overlapping tets of a mesh. The volume of such a mesh is meaningless, and its surface has holes
// where two tets share a face on the same side.
#pragma once

#include <array>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns pairs of tets (smaller index first, sorted) whose projections overlap by more than 1e-7
// of the longest edge of the smaller tet on every axis; tets that share vertices, edges or faces
// included.
std::vector<std::array<int, 2>> overlapping_tets(const Mesh& mesh);

}  // namespace tack
