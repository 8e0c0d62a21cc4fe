// What the hinges of a sheet cost, so that they bend like a plate of bending stiffness D and Poisson's ratio nu.
//
// The curvature of a triangle is told by the angles of its three hinges, so its energy is 1/2 a^T C a, a = angles (3),
// C 3x3. A plate that is bent by a constant curvature K turns the hinge i by  c_i . K  (c_i follows from the two
// triangles), and exerts the moment  l_i n_i . M(K) n_i,  M = D ((1 - nu) K + nu tr K), on it. The stiffnesses C are
// fitted so that all hinges together do: sum over the two triangles of (C a(K))_i = l_i n_i . M(K) n_i for every K. There are
// as many unknowns as conditions. What meets them is consistent, and converges to the plate's theory as long as the C stay
// definite (Strang), which comes first: none has an eigenvalue below a twentieth of D's. At borders, those curvatures count
// that leave the border without a moment.
//
// Taken to begin with are the C of the curvature  sum_i l_i / (A + A_i) a_i n_i n_i^T  of a triangle of area A, for normals in the
// middle of edges that are interpolated between both sides (Onate and Zarate 2000). They meet all conditions where all triangles
// are alike. Then each hinge in turn changes what is its own as little as meets its conditions (Kaczmarz), and each triangle is
// made definite again. What else was tried: docs/design.md.
//
// Source of the moments: the constant moments of Morley's and Hellan-Herrmann-Johnson's plate elements (Comodi 1989).
#pragma once

#include <array>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// A triangle with what lies across its edges; edge i is opposite vertex i, from vertex i + 1 to i + 2.
struct SheetTriangle {
  std::array<int, 3> vertices;
  std::array<int, 3> across;    // the vertex opposite, of the neighbour; -1: a border
  std::array<int, 3> neighbour; // which triangle that is; -1
};

// Throws InputError, with `who` in front, if more than two triangles share an edge.
std::vector<SheetTriangle> connect_sheet(const std::vector<Triangle>& sheet, const std::string& who);

// C of each triangle [J]; rows and columns of borders are zero.
std::vector<Mat3> fit_hinges(const std::vector<SheetTriangle>& sheet, const VecX& rest, double stiffness, double poisson);

}  // namespace tack
