// The shape of a tet as a number.
#pragma once

#include <cmath>

#include "geometry/mesh/quality.hpp"

namespace tack {

// Mean ratio 12 (3 |V|)^(2/3) / (sum of the six squared edges), with the sign of V: 1 for a regular
// tet, 0 for a flat one, negative for an inverted one (Liu, Joe 1994).
double tet_quality(const Mesh& mesh, int tet);
inline double tet_quality(const Mesh& mesh, int tet) {
  double squared_edges = 0;
  const Tet& t = mesh.tets[tet];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) {
      squared_edges += (mesh.vertices[t[i]] - mesh.vertices[t[j]]).squaredNorm();
    }
  }
  if (squared_edges == 0) return 0;
  const double volume = tet_volume(mesh, tet);
  return std::copysign(12.0 * std::pow(3.0 * std::abs(volume), 2.0 / 3.0) / squared_edges, volume);
}

}  // namespace tack
