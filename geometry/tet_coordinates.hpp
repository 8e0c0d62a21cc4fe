// Barycentric coordinates in a tet.
#pragma once

#include <Eigen/LU>
#include <array>

#include "geometry/tet_edges.hpp"

namespace tack {

// Returns the barycentric coordinates of a point; their sum is one, and they are positive inside.
inline std::array<double, 4> tet_coordinates(const std::array<Vec3, 4>& corners,
                                             const Vec3& point) {
  const Vec3 w = edges_of(corners).inverse() * (point - corners[0]);
  return {1 - w.sum(), w(0), w(1), w(2)};
}

}  // namespace tack
