// Shape measure of a tet, its mean ratio
//     q = 12 (3 V)^(2/3) / sum of squared edges,
// 1 for a regular tet, 0 for a flat or an inverted one; independent of the size.
// Source: Liu and Joe 1994, Relationship between tetrahedron shape measures.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "geometry/types.hpp"

namespace tack {

inline double mean_ratio(const std::array<Vec3, 4>& x) {
  double squares = 0;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < i; ++k) squares += (x[i] - x[k]).squaredNorm();
  const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  const double three_volumes = a.cross(b).dot(c) / 2;
  return three_volumes > 0 ? 12 * std::cbrt(three_volumes * three_volumes) / squares : 0;
}

inline double mean_ratio(const Tet& tet, const VecX& x) { return mean_ratio(corners(x, tet)); }

}  // namespace tack
