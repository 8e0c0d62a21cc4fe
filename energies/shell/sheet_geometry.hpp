// Rest data of linear triangles: F = sum_a x_a (grad N_a)^T, 3x2, in a frame of each triangle's
// own.
#pragma once

#include <vector>

#include "energies/shell/plane_stretch.hpp"
#include "framework/body/body.hpp"

namespace tack {

using Mat2 = Eigen::Matrix2d;
using Mat32 = Eigen::Matrix<double, 3, 2>;

// T: double, or Pack for pack_width triangles side by side.
template <class T>
struct SheetRest {
  Eigen::Matrix<T, 2, 2> shape;  // row a-1: grad N_a, a = 1, 2 [1/m]; grad N_0 is minus their sum
  T volume;                      // area times thickness [m^3]
};

// Throws InputError naming the body if it has no sheet, or one without thickness; and the triangle
// that has no area.
void require_sheet(const Body& body, const VecX& rest, std::string_view energy);

// The frame of a triangle: along its first edge, and across. 3x2.
Mat32 sheet_frame(const Triangle& triangle, const VecX& rest);
std::vector<SheetRest<double>> sheet_rest_data(const Body& body, const VecX& rest);

// Adds a third of each triangle's mass to its vertices [kg].
void add_sheet_mass(const Body& body, const VecX& rest, double density, VecX& mass);

inline Mat32 deformation_gradient(const SheetRest<double>& rest, const Triangle& t, const VecX& x) {
  Mat32 edges;
  for (int a = 0; a < 2; ++a) edges.col(a) = vertex(x, t[a + 1]) - vertex(x, t[0]);
  return edges * rest.shape;
}

// Returns the deformation gradients of triangles[0 .. count), count <= pack_width; further lanes
// repeat the last one.
inline PackMat32 deformation_gradient(const SheetRest<Pack>& rest, const Triangle* triangles,
                                      int count, const VecX& x) {
  PackMat3 corners;
  for (int l = 0; l < pack_width; ++l) {
    const Triangle& t = triangles[l < count ? l : count - 1];
    for (int a = 0; a < 3; ++a)
      for (int d = 0; d < 3; ++d) corners(d, a).set(l, x[3 * t[a] + d]);
  }
  PackMat32 edges;
  for (int a = 0; a < 2; ++a) edges.col(a) = corners.col(a + 1) - corners.col(0);
  return edges * rest.shape;
}

}  // namespace tack
