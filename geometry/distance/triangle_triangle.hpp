// How far apart two triangles are at least that do not intersect.
#pragma once

#include "geometry/types.hpp"

namespace tack {

// A lower bound of their distance [m]: the distance itself (within rounding) where that is less than `enough`, and at least that elsewhere.
double triangles_apart(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double enough);

}  // namespace tack
