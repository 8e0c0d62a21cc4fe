// Repair of surfaces: the result bounds a solid, or is a sheet. Vertices merged, triangles that are
// degenerate, duplicated or dangle removed, neighbours turned alike, crossing parts united,
// triangles that cross within a part replaced, holes filled, normals turned outwards (CGAL's
// polygon mesh processing).
#pragma once

#include <optional>

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

enum class Holes {
  // Fills holes of at most a tenth of the area of their component; other components are sheets.
  of_solids,
  fill,       // all; a part that its own filling would lie on is refused
  keep        // none
};

struct RepairOptions {
  // Vertices that close [m] become one; unless given, as close as single precision (STL) rounds
  // coordinates of that size, and no ends of one edge.
  std::optional<double> merge;
  Holes holes = Holes::of_solids;
};

// Notes its changes, with the numbers of elements of the given mesh. A defect that remains throws
// InputError, beginning with `name`, with the numbers of what was bad and where it still is.
Mesh repair(const Mesh& mesh, const RepairOptions& options, const std::string& name, Notes& notes);

}  // namespace tack
