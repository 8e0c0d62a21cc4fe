// Basic types of all layers. SI units. A configuration of n vertices is a flat vector of 3n
// coordinates (x0 y0 z0 x1 ...), which is also the argument of the minimisers.
#pragma once

#include <Eigen/Core>
#include <array>

// Alignment is equal for all instruction sets, so that plugins compiled for another one share
// arrays with the program. Plugins get these settings from the target tack::plugin.
static_assert(EIGEN_MAX_ALIGN_BYTES == 64 && EIGEN_MAX_STATIC_ALIGN_BYTES == 64);

namespace tack {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec9 = Eigen::Matrix<double, 9, 1>;
using Vec12 = Eigen::Matrix<double, 12, 1>;
using VecX = Eigen::VectorXd;
using Mat3 = Eigen::Matrix3d;
using Mat9 = Eigen::Matrix<double, 9, 9>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

using Edge = std::array<int, 2>;
using Triangle = std::array<int, 3>;
using Tet = std::array<int, 4>;

// Returns vertex i of a flat configuration as a 3-vector (an Eigen view, no copy).
inline auto vertex(const VecX& x, int i) { return x.segment<3>(3 * i); }
inline auto vertex(VecX& x, int i) { return x.segment<3>(3 * i); }

// Returns the vertices of an element.
template <size_t N>
std::array<Vec3, N> corners(const VecX& x, const std::array<int, N>& element) {
  std::array<Vec3, N> c;
  for (size_t i = 0; i < N; ++i) c[i] = vertex(x, element[i]);
  return c;
}

// Returns the point with the given barycentric coordinates.
inline Vec3 point_inside(const VecX& x, const Triangle& t, const Vec3& coordinates) {
  return coordinates[0] * vertex(x, t[0]) + coordinates[1] * vertex(x, t[1]) +
         coordinates[2] * vertex(x, t[2]);
}

}  // namespace tack
