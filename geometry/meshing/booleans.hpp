// Union, difference and intersection of solids, and cuts by a plane (CGAL's corefinement: which
// triangles meet is decided exactly; new vertices are rounded to the nearest double).
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

enum class Boolean { unite, subtract, intersect };  // A or B, A without B, A and B

// Returns the union, difference or intersection of two closed surfaces with outward normals that do
// not cross themselves (require_solid). Throws InputError, which begins with the mesh's name, for
// any other surface, for an empty result, and for a result that touches itself in an edge or a
// vertex.
Mesh boolean(Boolean kind, const Mesh& a, const Mesh& b, const std::string& name_a,
             const std::string& name_b, Notes& notes);

// Returns the part of a solid on the negative side of the plane, closed by the cut. The normal
// needs no unit length. Throws InputError as `boolean` does, also for a normal of length zero or an
// empty result.
Mesh cut(const Mesh& mesh, const Vec3& point, const Vec3& normal, const std::string& name,
         Notes& notes);

}  // namespace tack
