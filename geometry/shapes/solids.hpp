// Tetrahedral meshes of simple solids, centred at the origin, every tet positive. Lengths in
// metres. All are maps of one structured cube (kuhn.hpp): node (i, j, k) is vertex i + (nx+1)(j +
// (ny+1)k), six tets per cell, cells in the same order.
// Errors: InputError for a size that is not positive, a number of cells below 1, or an odd number
// where it must be even.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns a box with nodes at -size/2 + size (i/nx, j/ny, k/nz). The six tets of a cell share its
// diagonal from corner (0,0,0) to (1,1,1).
Mesh box_tets(const Vec3& size, const std::array<int, 3>& cells);

// Returns a ball with `cells` (even) cells across its diameter. Cell diagonals point away from the
// centre, so that no tet has two faces on the sphere. The mean ratio of the worst tet is at least
// 0.64, the volume ratio of the largest to the smallest tet at most 1.6.
Mesh sphere(double radius, int cells);

// Returns a solid cylinder about the y axis with `cells_across` (even) cells across its diameter.
// In the projection along y, cell diagonals point away from the axis.
Mesh cylinder(double radius, double height, int cells_across, int cells_along);

// A stone of an arch about the z axis, at its position in the arch: its crown at (0, r, 0), its
// flat sides on planes through the axis at -angle/2 and angle/2 from +y, each moved inwards by
// joint/2. Before that, corners have the inner and outer radius; top and bottom are flat. `cells`:
// along the arc (x), the radius (y) and the axis (z). The angle is below pi, the inner radius below
// the outer one.
struct Voussoir {
  double inner_radius = 0.9, outer_radius = 1.1;  // m
  double angle = 0.1;                             // rad
  double depth = 0.2;                             // along z [m]
  double joint = 0;                               // m
};
Mesh voussoir(const Voussoir& stone, const std::array<int, 3>& cells);

}  // namespace tack
