// Zero surface of a function, with its creases and corners.
#pragma once

#include "geometry/level_set/distance_grid.hpp"

namespace tack {

// Returns triangles with edges of about a voxel [m] and normals towards positive values; empty if
// the function is nowhere negative. Vertices are on the zero; those near a crease or corner are on
// the planes of all its sides, as in dual contouring (Ju, Losasso, Schaefer and Warren 2002,
// equation 1). function, box: see DistanceGrid::of.
Mesh zero_surface(const DistanceFunction& function, const Eigen::AlignedBox3d& box, double voxel);

}  // namespace tack
