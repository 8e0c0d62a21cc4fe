// Repairs that change the list of vertices or elements of a mesh. All keep the order of the
// remaining ones and remap the groups in Mesh::tags. Coordinates must be finite (validate.hpp).
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Merges each vertex with the first kept vertex at most `tolerance` [m] away; 0 merges equal
// coordinates only. Elements that collapse are removed. Throws InputError for a negative or
// non-finite tolerance.
void merge_duplicate_vertices(Mesh& mesh, double tolerance = 0);

// Removes triangles that are faces of tets, edges that are edges of tets or triangles, and points
// that are vertices of any of them: mesh files list them only to name groups.
void drop_redundant_elements(Mesh& mesh);

// Removes vertices that no element uses.
void drop_unused_vertices(Mesh& mesh);

}  // namespace tack
