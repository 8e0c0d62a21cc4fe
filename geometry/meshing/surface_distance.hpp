// Distance between two surfaces, measured from each to the other.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct SurfaceDistance {
  double largest = 0;  // [m]
  double rms = 0;      // over the area [m]
  Vec3 place = Vec3::Zero();  // where on the first surface it is largest [m]
};

// Measures from points of `from`, at most `spacing` [m] apart and all its vertices, to the closest
// point of `to`; both have triangles (triangle_surface.hpp). At most 64 x 64 points are taken of a
// triangle. The largest distance of all points of a triangle is larger than that found by less than
// the spacing.
SurfaceDistance distance_from_to(const Mesh& from, const Mesh& to, double spacing);

}  // namespace tack
