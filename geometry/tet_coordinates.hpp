// A point in terms of the corners of a tet.
#pragma once

#include <Eigen/LU>
#include <array>

#include "geometry/types.hpp"

namespace tack {

// Its barycentric coordinates; they add up to one, and are positive inside.
inline std::array<double, 4> tet_coordinates(const std::array<Vec3, 4>& corners, const Vec3& point) {
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = corners[k + 1] - corners[0];
  const Vec3 w = edges.inverse() * (point - corners[0]);
  return {1 - w.sum(), w(0), w(1), w(2)};
}

}  // namespace tack
