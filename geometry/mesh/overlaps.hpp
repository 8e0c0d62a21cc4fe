// Overlapping tets of a mesh: duplicated, or in the same position. Such a mesh has no volume that
// means anything, and its surface has holes where two tets share a face on the same side.
#pragma once

#include <array>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns pairs of tets (smaller number first, sorted) that overlap by more than 1e-7 of the
// smaller one's longest edge, whichever way they are looked at; tets that share vertices, edges or
// faces included.
std::vector<std::array<int, 2>> overlapping_tets(const Mesh& mesh);

}  // namespace tack
