// Swept shapes of a profile in the plane: revolved about the y axis, from x towards -z
// (right-handed), with x its distance from the axis; or moved along z, from length/2 to -length/2.
// Normals of sheets point to the right of the direction of the profile: outwards if it runs
// counter-clockwise, or up beside the axis. Metres, radians. Vertex groups of a sweep with ends:
// start, end. Errors: InputError for a profile that crosses the axis or touches it where the result
// would be pinched, and for invalid sizes and counts.
#pragma once

#include <vector>

#include "geometry/mesh/flat_mesh.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// Divides a profile from corner to corner (and back to the first one, if `closed`) into about
// `cells` cells in all, equal on each side.
std::vector<Vec2> divided(const std::vector<Vec2>& corners, bool closed, int cells);

// Sweeps a profile to a sheet; a profile that ends where it began gives no duplicate vertices.
// cells: along the path; a turn needs three.
Mesh revolved_sheet(const std::vector<Vec2>& profile, double angle, int cells);
Mesh extruded_sheet(const std::vector<Vec2>& profile, double length, int cells);

// Sweeps a section to tets. Exact, except that circles become polygons: n cells of a turn have the
// fraction n/(2 pi) sin(2 pi/n) of its volume.
Mesh revolved_solid(const FlatMesh& section, double angle, int cells);
Mesh extruded_solid(const FlatMesh& section, double length, int cells);

}  // namespace tack
