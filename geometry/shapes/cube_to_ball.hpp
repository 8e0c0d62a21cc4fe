// Map of the cube [-1, 1]^n onto the unit ball (n = 3) or disc (n = 2). The shell max|p_i| = m maps
// to the sphere of radius m, and equal steps along an edge of the shell map to nearly equal angles
// (equiangular projection of the cubed sphere, Ronchi et al. 1996):
//     q = m tan(pi/4 p/m), x = m q/|q|.
// The map keeps the mirror symmetries of the cube exactly.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace tack {

template <int N>
Eigen::Matrix<double, N, 1> cube_to_ball(const Eigen::Matrix<double, N, 1>& p) {
  const double m = p.cwiseAbs().maxCoeff();
  if (m == 0) return p;
  Eigen::Matrix<double, N, 1> q;
  for (int i = 0; i < N; ++i) q[i] = std::tan(std::numbers::pi / 4 * (p[i] / m));
  return q * (m / q.norm());
}

}  // namespace tack
