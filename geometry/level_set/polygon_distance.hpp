// Signed distance to a polygon in the plane, exact everywhere; negative inside by the even-odd
// rule.
#pragma once

#include <span>

#include "geometry/types.hpp"

namespace tack {

double polygon_distance(const Vec2& p, std::span<const Vec2> corners);

}  // namespace tack
