// Signed distance to a polygon in the plane: negative inside by the even-odd rule, exact
// everywhere.
#pragma once

#include <span>

#include "geometry/types.hpp"

namespace tack {

double polygon_distance(const Vec2& p, std::span<const Vec2> corners);

}  // namespace tack
