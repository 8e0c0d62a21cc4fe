// What the hinges of a sheet cost, so that they bend like a plate of bending stiffness D and Poisson's ratio nu.
//
// The energy of a fan of hinges (sheet_fans.hpp) is 1/2 a^T C a, a = its angles, C symmetric. A plate that is bent by a constant
// curvature K turns the hinge i by  c_i . K  (c_i follows from its two triangles), and exerts the moment  l_i n_i . M(K) n_i,
// M = D ((1 - nu) K + nu tr K), on it. The stiffnesses C are fitted so that all hinges together do: sum over the fans of its two
// ends of (C a(K))_i = l_i n_i . M(K) n_i for every K. What meets that has the energy of every constant curvature and
// leaves the vertices within without forces (the patch test), and converges to the plate's theory as long as the C stay definite
// (Strang). At borders, those curvatures count that leave the border without a moment.
//
// Taken to begin with are the C of the mean curvature  sum_i l_i a_i n_i n_i^T / (2 A)  of a fan, A its share of the area, which
// meet all conditions where all triangles are alike, and little against angles that are those of no curvature: not much is
// needed, and more makes coarse meshes stiff. Each hinge in turn changes what is its own as little as meets its conditions
// (Kaczmarz), and each fan is made definite again, a little more than it has to be, so that this comes to an end. Fans of six hinges
// will do where meshes are regular; where they do not, fans of eight are taken, which couple more vertices. What else was
// tried, and why no C of the hinges of a triangle will do: docs/decisions/45-sheet-bending.md.
//
// Source of the moments: the constant moments of Morley's and Hellan-Herrmann-Johnson's plate elements (Comodi 1989).
#pragma once

#include <vector>

#include "energies/shell/sheet_fans.hpp"

namespace tack {

using FanMatrix = Eigen::Matrix<double, most_hinges, most_hinges>;  // beyond the hinges of a fan: nothing of interest

struct FittedFans {
  std::vector<HingeFan> fans;
  std::vector<FanMatrix> c;  // of each [J]
  double off;                // of the moments, what conditions are off by in the mean
};

FittedFans fit_hinges(const std::vector<SheetTriangle>& sheet, const VecX& rest, double stiffness, double poisson);

}  // namespace tack
