// Validation of meshes for simulation. A failed check throws InputError with the mesh (usually its
// file), the first offending element and the remedy. Checks, in this order:
//   at least one element; indices within the vertices; finite coordinates; no vertex twice in an
//   element; no tet with volume <= 1e-14 L^3, no triangle with area <= 1e-14 L^2, no edge of
//   length zero (L: the element's longest edge); no vertex that no element uses; no tets that
//   overlap (overlaps.hpp); no triangle of a sheet and no edge of a rod twice.
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

void validate_mesh(const Mesh& mesh, const std::string& name);

// Checks without which other functions must not use a mesh.
void validate_indices(const Mesh& mesh, const std::string& name);
void validate_coordinates(const Mesh& mesh, const std::string& name);

}  // namespace tack
