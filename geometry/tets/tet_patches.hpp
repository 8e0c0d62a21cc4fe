// Patches of neighbouring tets, over which a change of volume is averaged: the six tets of a cell
// in structured meshes (geometry/shapes/kuhn.hpp); elsewhere most of the tets around a vertex with
// many tets, and the remaining tets between such patches.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

inline constexpr int largest_patch = 24;  // vertices

// Returns the patch of each tet, numbered from 0 in the order of their first tets.
std::vector<int> tet_patches(const std::vector<Tet>& tets);

}  // namespace tack
