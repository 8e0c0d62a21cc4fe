// Stiffnesses of the hinges of a sheet that bends like a plate of bending stiffness D and Poisson's
// ratio nu.
//
// The energy of a fan of hinges (sheet_fans.hpp) is 1/2 a^T C a, a its angles, C symmetric. A plate
// with a constant curvature K turns hinge i by c_i . K (c_i follows from its two triangles) and
// exerts the moment l_i n_i . M(K) n_i on it, M = D ((1 - nu) K + nu tr K). Condition on C: the sum
// over the fans of both ends of hinge i satisfies
//     sum (C a(K))_i = l_i n_i . M(K) n_i   for every K.
// Such C give the energy of every constant curvature and no forces on inner vertices (the patch
// test), and converge to plate theory as long as C stays definite (Strang). At borders, only
// curvatures without a moment at the border count.
//
// Initial C: from the mean curvature sum_i l_i a_i n_i n_i^T / (2 A) of a fan, A its tributary
// area, which meets all conditions if all triangles are equal; plus a small stiffness of angles of
// no curvature (a larger one makes coarse meshes stiff). Iteration: each hinge changes its own
// entries by the smallest amount that meets its conditions (Kaczmarz), then each fan is made
// definite with a small margin, so that the iteration ends. Fans of six hinges suffice for regular
// meshes; else fans of eight are used, which couple more vertices. Alternatives:
// docs/decisions/45-sheet-bending.md.
//
// Source of the moments: the constant moments of Morley's and Hellan-Herrmann-Johnson's plate
// elements (Comodi 1989).
#pragma once

#include <vector>

#include "energies/shell/sheet_fans.hpp"

namespace tack {

// Entries beyond the hinges of a fan: unused
using FanMatrix = Eigen::Matrix<double, most_hinges, most_hinges>;

struct FittedFans {
  std::vector<HingeFan> fans;
  std::vector<FanMatrix> c;  // of each [J]
  double off;                // mean error of the conditions, relative to the moments
};

FittedFans fit_hinges(const std::vector<SheetTriangle>& sheet, const VecX& rest, double stiffness,
                      double poisson);

}  // namespace tack
