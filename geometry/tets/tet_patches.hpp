// Patches of neighbouring tets, over which a change of volume is averaged: the six around the
// diagonal of a cell where a mesh is made of such cells (geometry/shapes/kuhn.hpp); elsewhere most
// of the tets around a vertex, of vertices that have many, and the tets left between them.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

inline constexpr int largest_patch = 24;  // vertices

// The patch of each tet, numbered from 0 in the order of their first tets.
std::vector<int> tet_patches(const std::vector<Tet>& tets);

}  // namespace tack
