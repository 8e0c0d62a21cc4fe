// A broken surface made into the border of a solid, as far as can be: vertices merged, triangles that are degenerate,
// duplicated or dangle removed, neighbours turned alike, crossing parts united, triangles that cross within a part
// replaced, holes filled, normals turned outwards (CGAL's polygon mesh processing).
#pragma once

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

struct RepairOptions {
  double merge = 0;           // vertices that close [m] become one
  bool fill_holes = true;     // otherwise open edges stay
};

// Tells what it did, with the numbers of elements of the mesh that was given. What could not be repaired throws
// InputError, beginning with `name`, with the numbers of what was bad and where it still is.
Mesh repair(const Mesh& mesh, const RepairOptions& options, const std::string& name, Notes& notes);

}  // namespace tack
