// Stiffnesses of the dihedral edges of a sheet that bends like a plate of bending stiffness D and
// Poisson's ratio nu.
//
// A fan of dihedral edges (sheet_fans.hpp) has the energy 1/2 a^T C a, a its angles, C symmetric. A
// plate with a constant curvature K turns dihedral edge i by c_i . K (c_i follows from its two
// triangles) and exerts the moment l_i n_i . M(K) n_i on it, M = D ((1 - nu) K + nu tr K).
// Condition on C: the sum over the fans of both ends of dihedral edge i satisfies
//     sum (C a(K))_i = l_i n_i . M(K) n_i   for every K.
// Such C give the energy of every constant curvature and no forces on inner vertices (the patch
// test). They converge to plate theory as long as C stays definite (Strang). At borders, only
// curvatures without a moment at the border count.
//
// Initial C: from the mean curvature sum_i l_i a_i n_i n_i^T / (2 A) of a fan, A its tributary
// area, which meets all conditions if all triangles are equal; plus a small stiffness of angles of
// no curvature (a larger one makes coarse meshes stiff). Iteration: each dihedral edge changes its
// own entries by the smallest amount that meets its conditions (Kaczmarz), then each fan is made
// definite with a small margin, so that the iteration ends. Fans of six edges suffice for regular
// meshes; else fans of eight are used, which couple more vertices. Alternatives:
// docs/decisions/45-sheet-bending.md.
//
// Source of the moments: the constant moments of Morley's and Hellan-Herrmann-Johnson's plate
// elements (Comodi 1989).
#pragma once

#include <vector>

#include "energies/shell/sheet_fans.hpp"

namespace tack {

// Entries beyond the dihedral edges of a fan are unused.
using FanMatrix = Eigen::Matrix<double, fan_edges_max, fan_edges_max>;

struct FittedFans {
  std::vector<DihedralFan> fans;
  std::vector<FanMatrix> c;  // per fan [J]
  double error;              // mean error of the conditions, relative to the moments
};

// Returns the fans of a sheet and their stiffnesses. stiffness: D [N m]; poisson: nu.
FittedFans fit_dihedral_stiffness(const std::vector<SheetTriangle>& sheet, const VecX& rest,
                                  double stiffness, double poisson);

}  // namespace tack
