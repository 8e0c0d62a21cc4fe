// Simplification by edge collapses, in the order of least change of shape and volume (Lindstrom and
// Turk, Fast and memory efficient polygonal simplification, 1998; CGAL).
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

// Reduces a surface to at most `triangles` triangles, two at a time; a surface with fewer stays. No
// triangle flips. Where topology or normals allow no further collapse, more triangles remain, and a
// warning is added. Throws InputError, beginning with `name`, for a surface that is no oriented
// manifold.
Mesh simplify(const Mesh& mesh, int triangles, const std::string& name, Notes& notes);

}  // namespace tack
