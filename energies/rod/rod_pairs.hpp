// Which edges of a rod bend and twist against each other: at every vertex, all pairs of the edges that meet there.
//     A weld is a rigid node to which each edge is tied by its half, of stiffness k_i = 2 B / L_i. Without the node, whose
// rotation follows from balance, that is a spring between every two edges with k_ij = k_i k_j / sum_m k_m (star to mesh), B over the
// length L_i L_j / 2 sum_m 1 / L_m. Of two edges that is the Voronoi length (L_i + L_j) / 2 of Bergou et al.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct RodPair {
  int first, second;  // numbers of edges
  int vertex;         // that they share
  double length;      // m
  bool joint;         // more than two edges meet there
};

// In the order of vertices. rest: 3n [m].
std::vector<RodPair> rod_pairs(const std::vector<Edge>& edges, const VecX& rest);

}  // namespace tack
