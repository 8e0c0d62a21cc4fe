// Rest data of linear tetrahedra: F = sum_a x_a (grad N_a)^T.
#pragma once

#include <vector>

#include "framework/body/body.hpp"
#include "geometry/pack.hpp"
#include "geometry/tet_edges.hpp"

namespace tack {

// T: double, or Pack for pack_width tets side by side.
template <class T>
struct TetRest {
  // Row a-1: grad N_a, a = 1, 2, 3 [1/m]; grad N_0 is minus their sum
  Eigen::Matrix<T, 3, 3> shape;
  T volume;  // [m^3]
};

// Throws InputError naming the body and the tet if one is not positively oriented.
std::vector<TetRest<double>> tet_rest_data(const Body& body, const VecX& rest);

inline Mat3 deformation_gradient(const TetRest<double>& rest, const Tet& tet, const VecX& x) {
  return edges_of(tet, x) * rest.shape;
}

// Returns the deformation gradients of tets[0 .. count), count <= pack_width; further lanes repeat
// the last one.
inline PackMat3 deformation_gradient(const TetRest<Pack>& rest, const Tet* tets, int count,
                                     const VecX& x) {
  PackMatrix<3, 4> corners;
  for (int l = 0; l < pack_width; ++l) {
    const Tet& tet = tets[l < count ? l : count - 1];
    for (int a = 0; a < 4; ++a)
      for (int d = 0; d < 3; ++d) corners(d, a).set(l, x[3 * tet[a] + d]);
  }
  PackMat3 edges;
  for (int a = 0; a < 3; ++a) edges.col(a) = corners.col(a + 1) - corners.col(0);
  return edges * rest.shape;
}

}  // namespace tack
