// Every triangle into four, again and again.
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

enum class SubdivisionRule {
  // smooths: the limit has continuous curvature (Loop, Smooth subdivision surfaces based on
  // triangles, 1987; CGAL).
  loop,
  flat   // at the middles of edges: the same surface
};

// Subdivides an oriented manifold, open or closed; else throws InputError, beginning with `name`,
// as for too many triangles.
Mesh subdivide(const Mesh& mesh, SubdivisionRule rule, int times, const std::string& name,
               Notes& notes);

}  // namespace tack
