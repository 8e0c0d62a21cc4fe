#include "energies/solid/composite_samples.hpp"

#include <Eigen/LU>
#include <cmath>

namespace tack {
namespace {

using Barycentric = Eigen::Vector4d;

Barycentric node(int n) {
  if (n < 4) return Barycentric::Unit(n);
  const auto& [a, b] = composite_edges[static_cast<size_t>(n - 4)];
  return (Barycentric::Unit(a) + Barycentric::Unit(b)) / 2;
}

CompositeTable made_table() {
  CompositeTable table{};
  for (auto& point : table.point)
    for (auto& row : point) row.fill(0);
  const double near = (5 + 3 * std::sqrt(5.0)) / 20, far = (5 - std::sqrt(5.0)) / 20;
  for (int s = 0; s < composite_parts; ++s) {
    const auto& corners = composite_tets[static_cast<size_t>(s)];
    // Coordinates are those of the tet's corners 1 to 3: x = sum over corners of N_i x_i, and c_i = grad N_i.
    Mat3 edges;
    Barycentric middle = node(corners[0]) / 4;
    for (int i = 0; i < 3; ++i) {
      edges.col(i) = (node(corners[i + 1]) - node(corners[0])).tail<3>();
      middle += node(corners[i + 1]) / 4;
    }
    const Mat3 gradients = edges.inverse();
    for (int i = 0; i < 4; ++i)
      for (int d = 0; d < 3; ++d)
        table.part[s][i][d] = i > 0 ? gradients(i - 1, d) : -(gradients(0, d) + gradients(1, d) + gradients(2, d));
    for (int q = 0; q < composite_points; ++q) {
      const Barycentric point = Barycentric::Constant(far) + (near - far) * Barycentric::Unit(q);
      const double weight = (5 * point.dot(middle) - 1) / 2;
      for (int i = 0; i < 4; ++i)
        for (int d = 0; d < 3; ++d) table.point[q][corners[i]][d] += weight * table.part[s][i][d];
    }
  }
  return table;
}

}  // namespace

const CompositeTable& composite_table() {
  static const CompositeTable table = made_table();
  return table;
}

}  // namespace tack
