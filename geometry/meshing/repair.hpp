// A broken surface made whole: the border of a solid, or a sheet that is one. Vertices merged, triangles that are degenerate,
// duplicated or dangle removed, neighbours turned alike, crossing parts united, triangles that cross within a part
// replaced, holes filled, normals turned outwards (CGAL's polygon mesh processing).
#pragma once

#include <optional>

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

enum class Holes {
  of_solids,  // filled where what is missing is little: at most a tenth of the area of the part; other parts are sheets, whose borders stay
  fill,       // all; a part that its own filling would lie on is refused
  keep        // none
};

struct RepairOptions {
  // Vertices that close [m] become one; unless given, as close as single precision (STL) rounds
  // coordinates of that size, and no ends of one edge.
  std::optional<double> merge;
  Holes holes = Holes::of_solids;
};

// Tells what it did, with the numbers of elements of the mesh that was given. What could not be repaired throws
// InputError, beginning with `name`, with the numbers of what was bad and where it still is.
Mesh repair(const Mesh& mesh, const RepairOptions& options, const std::string& name, Notes& notes);

}  // namespace tack
