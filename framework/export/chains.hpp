// Edges of rods as polygonal chains.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

// Returns chains of vertices that contain each edge once. Chains end where other than two edges
// meet; the last vertex of a closed one is its first. The order is that of the edges.
std::vector<std::vector<int>> chains_of(const std::vector<Edge>& edges);

}  // namespace tack
