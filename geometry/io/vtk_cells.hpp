// Converts points and cells read by VTK to a mesh: vertices in their order, polygons cut into
// triangles.
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

class vtkDataSet;

namespace tack {

// Throws InputError, beginning with `name`, for data without points, cells of other kinds, indices
// out of range, and coordinates that are not finite.
Mesh mesh_of(vtkDataSet& data, const std::string& name);

}  // namespace tack
