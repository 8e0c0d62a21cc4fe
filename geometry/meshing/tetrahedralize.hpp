// Tets inside a closed surface: Delaunay refinement with sharp edges protected, then slivers are
// perturbed and exuded, as far as the surface stays a manifold (Jamin, Alliez, Yvinec, Boissonnat,
// CGALmesh: a generic framework for Delaunay mesh generation, 2015; Cheng, Dey, Ramos, Delaunay
// refinement for piecewise smooth complexes, 2010; CGAL).
#pragma once

#include <numbers>
#include <optional>

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

struct TetrahedralizeOptions {
  double edge_length = 0;  // approximate edge length of tets [m]
  // Approximate edge length of surface faces [m]; default: edge_length.
  std::optional<double> surface_edge_length = std::nullopt;
  // Largest distance between the surfaces, in both directions [m]; default: a tenth of their edge
  // length.
  std::optional<double> deviation = std::nullopt;
  // Largest ratio of circumradius to shortest edge of a tet, before slivers are treated.
  double radius_edge = 2;
  double dihedral_angle = 8 * std::numbers::pi / 180;  // smallest angle of tets [rad]
  // Angle between neighbouring normals above which an edge is kept [rad].
  double crease_angle = 40 * std::numbers::pi / 180;
};

// Fills a solid (require_solid) with positive tets, without unused vertices, whose surface is a
// closed manifold. Throws InputError, beginning with `name`, if the surface is no solid or that
// fails. A warning lists bounds that are not reached, with the worst element: dihedral angles
// cannot be larger than those between faces of the surface. Creases too close to each other to be
// protected are rounded, the bluntest first, with a warning. The same input gives the same bits.
Mesh tetrahedralize(const Mesh& mesh, const TetrahedralizeOptions& options, const std::string& name,
                    Notes& notes);

}  // namespace tack
