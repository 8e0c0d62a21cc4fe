// Subdivision of triangles into four each.
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

enum class SubdivisionRule {
  // Smooths; the limit surface has continuous curvature (Loop, Smooth subdivision surfaces based on
  // triangles, 1987; CGAL).
  loop,
  flat  // new vertices at the midpoints of edges; the surface is unchanged
};

// Subdivides an oriented manifold, open or closed, `times` times. Throws InputError, beginning with
// `name`, for other surfaces and for too many triangles.
Mesh subdivide(const Mesh& mesh, SubdivisionRule rule, int times, const std::string& name,
               Notes& notes);

}  // namespace tack
