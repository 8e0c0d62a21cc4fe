// Cuts a piece of a triangle along the rims that run over it. A rim is seen as the plane through an edge of the other
// surface, perpendicular to the triangle of that edge; on the piece it is a straight line. Several lines cut it into
// convex faces, each of which is covered as a whole or not at all, so that areas change continuously with what moves.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/held_surface.hpp"
#include "framework/contact/part_of_surface.hpp"

namespace tack {

struct RimLine {
  int triangle, side;  // of the edge
  Vec3 at, outward;    // a point of it, the unit normal of its plane away from the triangle
};

struct CutCorner {
  Vec3 inside;  // barycentric coordinates
  int line;     // along which the edge runs that begins here; -1: none
  bool beyond;  // on which side of it the face lies
};
using CutFace = std::vector<CutCorner>;

// Adds the lines of the creases and boundaries in which the closest point of a triangle to p lies, and of the seams of the part that it is of (null: none).
void add_rim_lines(const CollisionMesh& mesh, const HeldSurface& held, const PartOfSurface* part, int triangle, const Vec3& p,
                   std::vector<RimLine>& lines);

// Of the piece with those corners of the triangle `own`.
std::vector<CutFace> cut_by_rims(const VecX& x, const Triangle& own, const std::array<Vec3, 3>& piece,
                                 const std::vector<RimLine>& lines);

}  // namespace tack
