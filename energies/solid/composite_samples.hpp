// Quadrature of a composite tet. With its ten nodes x_a (columns, geometry/tets/divide_tets.hpp)
// and `shape` of its corners (tet_geometry.hpp), sample k has
//     F_k = (sum_a x_a c_ka^T) shape,
// with constants c_ka in R^3, because every part has an eighth of the volume.
//   samples 0-3   points of the rule of degree two, a quarter of the volume each: the deformation
//                 gradients of the parts, constant in each, projected (L2) onto linear functions
//   samples 4-11  the parts
// Sources: Thoutireddy et al. 2002, Tetrahedral composite finite elements; Ostien et al. 2016, A
// 10-node composite tetrahedral finite element.
#pragma once

#include <array>

#include "geometry/tets/divide_tets.hpp"

namespace tack {

inline constexpr int composite_points = 4;
inline constexpr int composite_samples = composite_points + composite_parts;

struct CompositeTable {
  using Row = std::array<double, 3>;
  std::array<std::array<Row, composite_nodes>, composite_points> point;  // c_ka
  // Constants of the corners of parts; other nodes do not count
  std::array<std::array<Row, 4>, composite_parts> part;
};

const CompositeTable& composite_table();

}  // namespace tack
