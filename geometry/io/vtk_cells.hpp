// Points and cells that VTK has read, as a mesh: vertices in their order, polygons cut into triangles.
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

class vtkDataSet;

namespace tack {

// Throws InputError, beginning with `name`: what has no points of its own, cells of other kinds, indices out of range, coordinates that are not finite.
Mesh mesh_of(vtkDataSet& data, const std::string& name);

}  // namespace tack
