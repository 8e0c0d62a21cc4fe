// Gradients of the barycentric coordinates of a triangle.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "geometry/types.hpp"

namespace tack {

// Returns the gradients of the barycentric coordinates of a triangle, in its plane [1/m].
inline std::array<Vec3, 3> barycentric_slopes(const std::array<Vec3, 3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const Vec3 over = normal / normal.squaredNorm();
  return {over.cross(t[2] - t[1]), over.cross(t[0] - t[2]), over.cross(t[1] - t[0])};
}

}  // namespace tack
