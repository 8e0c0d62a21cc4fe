// A box with round edges and corners. Lengths in metres.
#pragma once

#include <array>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Moves the vertices of a mesh of a box about the origin, tets or a surface, that are nearer to two
// or three of its sides than `rounding`: edges become quarters of cylinders, corners eighths of
// balls. Its flat sides stay flat and straight; vertices of the surface lie exactly on the rounded
// one, those inside follow (cube_to_ball.hpp). Errors: InputError if `rounding` is negative or more
// than half of a side, or if one of the `cells` along the sides is longer than it.
void round_box(Mesh& mesh, const Vec3& size, const std::array<int, 3>& cells, double rounding);

}  // namespace tack
