// Simplification: edges are collapsed in the order in which that changes shape and volume least
// (Lindstrom and Turk, Fast and memory efficient polygonal simplification, 1998; CGAL).
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

// Reduces a surface to at most that many triangles, two at a time. No triangle turns over. Throws
// InputError, beginning with `name`, for a surface that is no oriented manifold; with fewer
// triangles already, it stays as it is. Where topology or normals allow no further collapse, more
// remain: a warning.
Mesh simplify(const Mesh& mesh, int triangles, const std::string& name, Notes& notes);

}  // namespace tack
