// Pairs of edges of a rod that bend and twist against each other: all pairs that meet at a vertex.
// A weld is a rigid node to which each edge is attached by its half, of stiffness k_i = 2 B / L_i.
// Eliminating the rotation of the node (star to mesh) leaves a spring between every two edges,
//     k_ij = k_i k_j / sum_m k_m,   that is B over the length L_i L_j / 2 sum_m 1 / L_m.
// For two edges that is the Voronoi length (L_i + L_j) / 2 of Bergou et al.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct RodPair {
  int first, second;  // numbers of edges
  int vertex;         // shared by both edges
  double length;      // m
  bool joint;         // more than two edges meet there
};

// Returns the pairs in the order of their vertices. rest: 3n [m].
std::vector<RodPair> rod_pairs(const std::vector<Edge>& edges, const VecX& rest);

}  // namespace tack
