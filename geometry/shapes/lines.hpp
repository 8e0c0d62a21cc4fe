// Meshes of edges or points, centred at the origin. Lengths in metres.
// Errors: InputError for a size that is not positive or a count below 1.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns a straight rod along x from -length/2 to length/2: vertex i at -length/2 + length
// i/edges, edge i from vertex i to i + 1.
Mesh segment(double length, int edges);

// Returns a closed polygon in the plane y = 0: vertex i at the angle 2 pi i/edges from x towards -z
// (right-handed about y), edge i from vertex i to the next.
Mesh ring(double radius, int edges);

// Returns a right-handed helix about the y axis that rises by the pitch in each turn, from y =
// -height/2 to height/2 = turns pitch / 2. It starts at azimuth x; vertices are evenly spaced.
Mesh helix(double radius, double pitch, double turns, int edges);

// Returns straight threads in the plane y = 0 along x and z, with cells[0] x cells[1] meshes; each
// side of a mesh has `edges` edges. Knots come first: (i, j) is vertex i + (cells[0] + 1) j. Tags:
// knots, border (vertices on the outline).
Mesh net(const Vec2& size, const std::array<int, 2>& cells, int edges);

// Returns a spider's web in the plane y = 0: straight spokes from the centre to a radius, and a
// spiral on them that winds outward from the inner radius. Straight segments are divided into edges
// no longer than edge_length. Tags: centre, ends (outer ends of the spokes), spiral.
Mesh web(double radius, double inner_radius, int spokes, int turns, double edge_length);

// Returns counts[0] x counts[1] x counts[2] particles, the outermost at +-size/2. On an axis with
// one particle, it is at 0 and the size is ignored. Particle (i, j, k) is vertex
// i + counts[0] (j + counts[1] k).
Mesh point_grid(const Vec3& size, const std::array<int, 3>& counts);

}  // namespace tack
