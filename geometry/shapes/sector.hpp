// Thin sector of a body of revolution about y, for axisymmetric problems: one cell wide, with
// graded cells along radius and depth. Its top is the plane y = 0, or a crown that touches the
// plane from below. It extends to both sides of the x axis.
#pragma once

#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns nodes from 0 to the last position, with cell lengths interpolated between {position,
// length}. Throws InputError for positions that do not ascend from 0, and lengths that are not
// positive.
std::vector<double> graded(const std::vector<Vec2>& cells);

struct Sector {
  double angle = 0;            // rad, below pi / 2
  double crown = 0;            // radius of the spherical top [m]; 0: flat
  std::vector<double> radii;   // of the vertices, from 0 [m]
  std::vector<double> depths;  // below the top on the axis, from 0 [m]; the bottom is flat
};

// Returns the mesh. Vertex groups: axis; left and right, the sides without the axis, at -angle / 2
// and +angle / 2 (from x to z); top, bottom and rim. Throws InputError for invalid angles, radii or
// depths, and for a crown smaller than the radius.
Mesh sector(const Sector& shape);

}  // namespace tack
