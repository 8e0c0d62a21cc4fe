// Closed surfaces within each other: a cavity faces inwards, and what floats in it outwards again.
#pragma once

#include <functional>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// How often the others enclose each part of closed triangles: their winding number at one of its
// vertices, +1 for a part around it that faces outwards, -1 for one that faces inwards. part: of
// each triangle, from 0 (parts_of); at: the place of a vertex [m]. Parts may not intersect each
// other; one that touches another has the nearest whole number.
std::vector<int> enclosing_windings(const std::vector<Triangle>& triangles,
                                    const std::vector<int>& part,
                                    const std::function<Vec3(int)>& at);

}  // namespace tack
