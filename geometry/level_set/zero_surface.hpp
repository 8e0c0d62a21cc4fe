// The surface where a function is zero, with its creases and corners.
#pragma once

#include "geometry/level_set/distance_grid.hpp"

namespace tack {

// Triangles with edges of about a voxel [m], whose normals point to where the function is positive;
// empty if it is negative nowhere. Vertices lie on the zero itself; those near a crease or a corner
// in the planes of both its sides, as in dual contouring (Ju, Losasso, Schaefer and Warren 2002,
// equation 1). function, box: as of DistanceGrid::of.
Mesh zero_surface(const DistanceFunction& function, const Eigen::AlignedBox3d& box, double voxel);

}  // namespace tack
