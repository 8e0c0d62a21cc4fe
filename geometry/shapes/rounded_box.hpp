// Rounding of boxes. Lengths in metres.
#pragma once

#include <array>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Rounds the edges and corners of a box about the origin, of tets or triangles: it moves vertices
// that are nearer than `rounding` to two or three sides. Edges become quarters of cylinders,
// corners eighths of balls. Flat sides stay flat; surface vertices are exactly on the rounded
// surface, and interior vertices are mapped by cube_to_ball.hpp. Throws InputError if `rounding` is
// negative or more than half of a side, or if a cell is longer than it.
void round_box(Mesh& mesh, const Vec3& size, const std::array<int, 3>& cells, double rounding);

}  // namespace tack
