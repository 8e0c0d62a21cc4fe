// Matrix of a cross product.
#pragma once

#include "geometry/types.hpp"

namespace tack {

// Returns [w]_x, for which [w]_x v = w.cross(v).
inline Mat3 cross_matrix(const Vec3& w) {
  Mat3 m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

}  // namespace tack
