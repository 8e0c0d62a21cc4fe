// Triangle meshes of simple surfaces, centred at the origin. Lengths in metres.
// Errors: InputError for a size that is not positive or a number of cells below 1.
#pragma once

#include "geometry/mesh/mesh.hpp"

namespace tack {

enum class Diagonals {
  uniform,     // every cell is cut from corner (0,0) to (1,1)
  alternating  // cells (i, k) with i + k odd are cut from (1,0) to (0,1) instead
};

// Returns a rectangle size[0] (x) by size[1] (z) in the plane y = 0, normals +y. Node (i, k) is at
// -size/2 + size (i/nx, k/nz) and is vertex i + (nx+1) k; two triangles per cell, cells x fastest.
// jitter: random displacement of interior nodes along x and z, as a fraction of a cell, below 1/4,
// so that no triangle flips; determined by the seed.
Mesh grid(const Vec2& size, const std::array<int, 2>& cells,
          Diagonals diagonals = Diagonals::alternating, double jitter = 0, int seed = 1);

// Returns the closed surface of a box, normals outward. Sides in the order -x, +x, -y, +y, -z, +z,
// each a grid of cells cut from corner (0,0) to (1,1); vertices in order of first use. One cell per
// axis: 8 vertices, 12 triangles.
Mesh box_surface(const Vec3& size, const std::array<int, 3>& cells = {1, 1, 1});

// Returns a geodesic sphere: every side of an icosahedron cut into cells^2 triangles, projected
// onto the sphere; 10 cells^2 + 2 vertices, 20 cells^2 triangles, normals outward. Vertices in
// order of first use.
Mesh sphere_surface(double radius, int cells);

}  // namespace tack
