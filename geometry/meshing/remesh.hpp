// Isotropic remeshing: edges of much the same length, vertices of much the same number of
// neighbours (Botsch and Kobbelt, A remeshing approach to multiresolution modeling, 2004; CGAL).
#pragma once

#include <numbers>

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

struct RemeshOptions {
  double edge_length = 0;      // aimed at [m]; most edges lie between 4/5 and 4/3 of it
  // Normals of neighbours that differ by more make a crease, which stays where it is [rad].
  double crease_angle = 40 * std::numbers::pi / 180;
  int iterations = 10;
};

// Remeshes a surface (triangle_surface.hpp), open or closed; borders and creases are divided anew,
// but do not move. New vertices lie on the old surface. Creases between which the surface would
// fold are not kept: a warning. Throws InputError, beginning with `name`, for one that is no
// oriented manifold.
Mesh remesh(const Mesh& mesh, const RemeshOptions& options, const std::string& name, Notes& notes);

}  // namespace tack
