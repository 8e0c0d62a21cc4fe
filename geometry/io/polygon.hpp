// Triangulation of the polygons of mesh files.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Appends a polygon (at least 3 vertices, in order around it) as a fan from the first corner from
// which every triangle has the orientation of the polygon; for convex polygons, its first corner.
// Throws InputError, beginning with `where`, if there is no such corner (strongly concave) or an
// index is out of range. where: the file and the polygon.
void add_polygon(Mesh& mesh, const std::vector<int>& polygon, const std::string& where);

}  // namespace tack
