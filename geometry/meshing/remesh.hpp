// Isotropic remeshing: edges of similar length, vertices with similar numbers of neighbours (Botsch
// and Kobbelt, A remeshing approach to multiresolution modeling, 2004; CGAL).
#pragma once

#include <numbers>

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

struct RemeshOptions {
  double edge_length = 0;  // target [m]; most edges are between 4/5 and 4/3 of it
  // Angle between neighbouring normals above which an edge is a crease, which is kept [rad].
  double crease_angle = 40 * std::numbers::pi / 180;
  int iterations = 10;
};

// Remeshes a surface (triangle_surface.hpp), open or closed. Borders and creases are divided again,
// but do not move. New vertices are on the old surface. Creases between which the surface would
// fold are not kept; a warning is added. Throws InputError, beginning with `name`, for a surface
// that is no oriented manifold.
Mesh remesh(const Mesh& mesh, const RemeshOptions& options, const std::string& name, Notes& notes);

}  // namespace tack
