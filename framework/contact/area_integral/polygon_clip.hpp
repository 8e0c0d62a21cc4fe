// Polygon clip: divides a subtriangle by the boundary lines of the opposite surface. A line
// is the intersection of the triangle with the plane through an edge of the other surface,
// perpendicular to the triangle of that edge. The resulting convex polygons overlap as a whole or
// not at all, so that overlap areas are continuous in the positions.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/surface/lagged_surface.hpp"
#include "framework/contact/surface/surface_region.hpp"

namespace tack {

struct ClipLine {
  int triangle, side;  // of the edge
  Vec3 at, outward;    // a point of the plane, its unit normal away from the triangle
};

struct ClipCorner {
  Vec3 inside;   // barycentric coordinates
  int line;      // the line of the edge that begins here; -1: none
  bool outside;  // whether the polygon lies on the outward side of that line
};
using ClipPolygon = std::vector<ClipCorner>;

// Appends the lines of the creases, boundaries and region interfaces in which the closest point of
// a triangle to p lies. region: null: none.
void add_clip_lines(const CollisionMesh& mesh, const LaggedSurface& lagged,
                    const SurfaceRegion* region, int triangle, const Vec3& p,
                    std::vector<ClipLine>& lines);

// Returns the polygons of a subtriangle of the triangle `own`. subtriangle: barycentric coordinates
// of its corners.
std::vector<ClipPolygon> clip_by_lines(const VecX& x, const Triangle& own,
                                       const std::array<Vec3, 3>& subtriangle,
                                       const std::vector<ClipLine>& lines);

}  // namespace tack
