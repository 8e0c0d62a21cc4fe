// Rest data of linear tetrahedra: F = sum_a x_a (grad N_a)^T.
#pragma once

#include <vector>

#include "framework/scene/body.hpp"

namespace tack {

struct TetRest {
  Mat3 shape;     // row a-1: grad N_a, a = 1, 2, 3 [1/m]; grad N_0 is minus their sum
  double volume;  // [m^3]
};

// Throws InputError naming the body and the tet if one is not positively oriented.
std::vector<TetRest> tet_rest_data(const Body& body, const VecX& rest);

inline Mat3 deformation_gradient(const TetRest& rest, const Tet& tet, const VecX& x) {
  Mat3 edges;
  const Vec3 origin = vertex(x, tet[0]);
  for (int a = 0; a < 3; ++a) edges.col(a) = vertex(x, tet[a + 1]) - origin;
  return edges * rest.shape;
}

}  // namespace tack
