// Triangles inside a polygon in the plane, by Delaunay refinement (Shewchuk, Delaunay refinement algorithms for triangular mesh generation, 2002; CGAL).
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh/flat_mesh.hpp"

namespace tack {

// Corners in either sense of rotation, which become vertices in their order, before those that are added, also on its sides. No edge is longer than the length
// [m], and no angle is below 20 degrees, except beside corners that are acute. Throws InputError, beginning with `name`, for a polygon whose sides cross or touch.
FlatMesh triangulate(const std::vector<Vec2>& polygon, double edge_length, const std::string& name);

}  // namespace tack
