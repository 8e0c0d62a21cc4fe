// Deviation of a surface from another one.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct SurfaceDeviation {
  double largest = 0;            // [m]
  double rms = 0;                // over the area [m]
  Vec3 position = Vec3::Zero();  // position of the largest distance on the first surface [m]
};

// Returns distances of points of `from`, all its vertices and points at most `spacing` [m] apart,
// to the closest points of `to`. Both meshes have triangles (triangle_surface.hpp). At most 64 x 64
// points per triangle are sampled. The exact largest distance exceeds the one found by less than
// the spacing.
SurfaceDeviation surface_deviation(const Mesh& from, const Mesh& to, double spacing);

}  // namespace tack
