// Triangles inside a polygon in the plane, by Delaunay refinement (Shewchuk, Delaunay refinement
// algorithms for triangular mesh generation, 2002; CGAL).
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh/flat_mesh.hpp"

namespace tack {

// Returns triangles inside a polygon. polygon: corners in either sense of rotation, which become
// the first vertices, in their order; vertices are added inside and on the sides. No edge is longer
// than `edge_length` [m], and no angle is below 20 degrees, except at acute corners. Throws
// InputError, beginning with `name`, for a polygon whose sides cross or touch.
FlatMesh triangulate(const std::vector<Vec2>& polygon, double edge_length, const std::string& name);

}  // namespace tack
