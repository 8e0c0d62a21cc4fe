// Edge matrix of a tet: edges from its first vertex to the others, as columns [m]. Its determinant
// is six times the volume.
#pragma once

#include "geometry/types.hpp"

namespace tack {

inline Mat3 edges_of(const std::array<Vec3, 4>& corners) {
  Mat3 edges;
  for (int a = 0; a < 3; ++a) edges.col(a) = corners[a + 1] - corners[0];
  return edges;
}

inline Mat3 edges_of(const Tet& tet, const VecX& x) {
  Mat3 edges;
  for (int a = 0; a < 3; ++a) edges.col(a) = vertex(x, tet[a + 1]) - vertex(x, tet[0]);
  return edges;
}

}  // namespace tack
