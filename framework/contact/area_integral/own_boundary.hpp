// Distance on a surface from a point to where the surface ends, or turns away from another one.
#pragma once

#include <limits>

#include "framework/contact/surface/lagged_surface.hpp"

namespace tack {

// Point on a triangle of a mesh.
struct SurfacePoint {
  int triangle;
  Vec3 inside;  // barycentric coordinates
};

// Returns the length [m] of the way from a point along `direction` (a unit vector), from triangle
// to triangle, to the boundary of the surface: an edge without another triangle that faces a
// surface of unit normal `facing`. Infinity where the way is longer than `limit` [m], and where
// that edge is not aligned with the direction: where it makes an angle of less than 75 degrees with
// it. All at the positions of the lagged surface.
double way_to_boundary(const CollisionMesh& mesh, const LaggedSurface& lagged, SurfacePoint from,
                       const Vec3& direction, const Vec3& facing, double limit);

}  // namespace tack
