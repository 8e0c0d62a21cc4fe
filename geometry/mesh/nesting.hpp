// Closed surfaces within each other: a cavity faces inwards; a component inside a cavity faces
// outwards.
#pragma once

#include <functional>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// Returns, per connected component of closed triangles, the winding number of the other components
// at one of its vertices: +1 for each enclosing component that faces outwards, -1 for each one that
// faces inwards. component: index per triangle (components_by_edges); at: position of a vertex [m].
// Components must not intersect; where two touch, the winding number is rounded.
std::vector<int> enclosing_windings(const std::vector<Triangle>& triangles,
                                    const std::vector<int>& component,
                                    const std::function<Vec3(int)>& at);

}  // namespace tack
