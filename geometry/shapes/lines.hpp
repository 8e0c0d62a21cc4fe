// Meshes without surface, centred at the origin. Lengths in metres.
// Errors: InputError for a size that is not positive or a count below 1.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Straight rod along x from -length/2 to length/2: vertex i at -length/2 + length i/edges, edge i
// from vertex i to i + 1.
Mesh segment(double length, int edges);

// Closed polygon in the plane y = 0: vertex i at the angle 2 pi i/edges from x towards -z (right-handed about y), edge i
// from vertex i to the next.
Mesh ring(double radius, int edges);

// Right-handed about the y axis, along which it rises by the pitch in each turn, from y = -height/2 to height/2 = turns pitch / 2; it
// starts above x, and its vertices are evenly spaced.
Mesh helix(double radius, double pitch, double turns, int edges);

// counts[0] x counts[1] x counts[2] particles, the outermost at +-size/2; an axis with one particle
// has it at 0 and its size is ignored. Particle (i, j, k) is vertex i + counts[0] (j + counts[1]
// k).
Mesh point_grid(const Vec3& size, const std::array<int, 3>& counts);

}  // namespace tack
