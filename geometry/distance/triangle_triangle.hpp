// Lower bound of the distance of two triangles that do not intersect.
#pragma once

#include "geometry/types.hpp"

namespace tack {

// Returns a lower bound of the distance of two triangles [m]: the distance itself (within rounding)
// if it is less than `enough`, else at least `enough`.
double triangles_apart(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double enough);

}  // namespace tack
