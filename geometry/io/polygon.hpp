// Cutting the polygons of mesh files into triangles.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Appends the polygon (vertices in order around it, at least 3) as a fan from its first corner from
// which every triangle of the fan faces the polygon's own way: for convex polygons the first
// corner. Errors: InputError when there is no such corner (strongly concave) or an index is out of
// range. `where` names the file and the polygon.
void add_polygon(Mesh& mesh, const std::vector<int>& polygon, const std::string& where);

}  // namespace tack
