// Repairs that change the list of vertices or elements of a mesh. All keep the order of what
// remains and remap the groups in Mesh::tags. Coordinates have to be finite (validate.hpp).
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Vertices at most `tolerance` metres from an earlier kept one become that one (the first such in
// vertex order; 0 merges only equal coordinates). Elements that collapse thereby are removed.
// Errors: InputError for a negative or non-finite tolerance.
void merge_duplicate_vertices(Mesh& mesh, double tolerance = 0);

// Removes triangles that are faces of tets, edges that are edges of tets or triangles, and points
// that are vertices of any of them: mesh files list those to carry group names, not as bodies.
void drop_redundant_elements(Mesh& mesh);

// Removes vertices that no element uses.
void drop_unused_vertices(Mesh& mesh);

}  // namespace tack
