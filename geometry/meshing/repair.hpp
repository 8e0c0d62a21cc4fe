// Repair of surfaces: the result bounds a solid, or is a sheet. Steps: merge vertices; remove
// degenerate, duplicated and dangling triangles; orient neighbours consistently; fill holes; unite
// components that cross; replace triangles that cross within a component; orient normals outwards
// (CGAL's polygon mesh processing).
#pragma once

#include <optional>

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

enum class Holes {
  // Fills holes of at most a tenth of the area of their component; other components are sheets.
  of_solids,
  fill,  // all; a component that would coincide with its own filling is refused
  keep   // none
};

struct RepairOptions {
  // Distance within which vertices are merged [m]; default: the single-precision rounding of the
  // coordinates (STL), without merging the ends of an edge.
  std::optional<double> merge;
  Holes holes = Holes::of_solids;
};

// Repairs a surface and adds its changes to `notes`, with indices of the input mesh. Throws
// InputError, beginning with `name`, for remaining defects, with their indices and positions.
Mesh repair(const Mesh& mesh, const RepairOptions& options, const std::string& name, Notes& notes);

}  // namespace tack
