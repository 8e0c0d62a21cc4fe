// Offset surface of a solid: points at a distance outside (or inside), meshed as a zero set by
// Delaunay refinement (Boissonnat and Oudot, Provably good sampling and meshing of
// surfaces, 2005; CGAL).
#pragma once

#include <optional>

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

struct OffsetOptions {
  double distance = 0;     // outwards if positive [m]
  double edge_length = 0;  // approximate edge length of the new surface [m]
  // Largest deviation of the new surface from the distance [m]; default: edge_length / 20.
  std::optional<double> deviation = std::nullopt;
};

// Offsets a solid (require_solid); the result is a closed manifold. Concave edges of the result are
// cut off by about the deviation. Throws InputError, beginning with `name`, for a surface that is
// no solid, and for an empty result.
Mesh offset(const Mesh& mesh, const OffsetOptions& options, const std::string& name, Notes& notes);

}  // namespace tack
