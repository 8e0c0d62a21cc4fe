// Tets inside a closed surface: Delaunay refinement with sharp edges protected, then slivers are
// perturbed and exuded (Jamin, Alliez, Yvinec, Boissonnat, CGALmesh: a generic framework for
// Delaunay mesh generation, 2015; Cheng, Dey, Ramos, Delaunay refinement for piecewise smooth
// complexes, 2010; CGAL).
#pragma once

#include <numbers>
#include <optional>

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

struct TetrahedralizeOptions {
  double edge_length = 0;                      // of the tets, about [m]
  // Approximate edge length of surface faces [m]; default: edge_length.
  std::optional<double> surface_edge_length = std::nullopt;
  // Largest distance between the surfaces, either way [m]; default: a tenth of their edge length.
  std::optional<double> deviation = std::nullopt;
  // Circumradius to shortest edge of a tet, before slivers are treated.
  double radius_edge = 2;
  double dihedral_angle = 8 * std::numbers::pi / 180;  // of every tet, at least [rad]
  // Normals of neighbours that differ by more make an edge that is kept [rad].
  double crease_angle = 40 * std::numbers::pi / 180;
};

// Meshes a solid (require_solid); else throws InputError, beginning with `name`. Tets are positive,
// no vertex is unused, their surface is a closed manifold: else InputError too. Bounds that are not
// reached are listed in a warning, with the worst element's number: dihedral angles cannot be
// larger than those between faces of the surface. Creases too close to each other to be protected
// are rounded, the bluntest first: a warning too. The same input gives the same bits.
Mesh tetrahedralize(const Mesh& mesh, const TetrahedralizeOptions& options, const std::string& name,
                    Notes& notes);

}  // namespace tack
