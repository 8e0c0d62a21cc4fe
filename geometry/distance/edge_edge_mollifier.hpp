// Mollifier of edge-edge energies, from Li et al. 2020, "Incremental Potential Contact", section on
// nearly parallel edges. Where two edges become parallel the distance loses its smoothness; the
// factor
//   m(c) = (2 - c / eps_x) c / eps_x  for c < eps_x, else 1,    c = |a x b|^2 [m^4],
// with a = ea1 - ea0, b = eb1 - eb0, takes the energy to zero there and is C1 at eps_x.
// eps_x = 1e-3 |a|^2 |b|^2 on rest positions [m^4]; for a rest edge of length zero it is 0, and m
// = 1. Stacking: (ea0, ea1, eb0, eb1).
#pragma once

#include <Eigen/Geometry>

#include "geometry/distance/stencil_derivatives.hpp"

namespace tack {

inline double edge_edge_mollifier_threshold(const Vec3& rest_ea0, const Vec3& rest_ea1,
                                            const Vec3& rest_eb0, const Vec3& rest_eb1) {
  return 1e-3 * (rest_ea1 - rest_ea0).squaredNorm() * (rest_eb1 - rest_eb0).squaredNorm();
}

inline double edge_edge_cross_squared(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                      const Vec3& eb1) {
  return (ea1 - ea0).cross(eb1 - eb0).squaredNorm();
}

inline double mollifier_value(double c, double eps_x) {
  return c < eps_x ? (2.0 - c / eps_x) * (c / eps_x) : 1.0;
}
inline double mollifier_slope(double c, double eps_x) {
  return c < eps_x ? 2.0 * (1.0 - c / eps_x) / eps_x : 0.0;
}
inline double mollifier_curvature(double c, double eps_x) {
  return c < eps_x ? -2.0 / (eps_x * eps_x) : 0.0;
}

// dc/da = 2 b x n and dc/db = 2 n x a, n = a x b; the two ends of an edge get opposite signs.
inline StencilGradient<12> edge_edge_cross_squared_gradient(const Vec3& ea0, const Vec3& ea1,
                                                            const Vec3& eb0, const Vec3& eb1) {
  const Vec3 a = ea1 - ea0, b = eb1 - eb0;
  const Vec3 n = a.cross(b);
  const Vec3 by_a = 2.0 * b.cross(n);
  const Vec3 by_b = 2.0 * n.cross(a);
  return {n.squaredNorm(),
          stacked<4>({-1.0, 1.0, 0.0, 0.0}, by_a) + stacked<4>({0.0, 0.0, -1.0, 1.0}, by_b)};
}

// From c = |a|^2 |b|^2 - (a.b)^2.
Mat12 edge_edge_cross_squared_hessian(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                      const Vec3& eb1);

inline double edge_edge_mollifier(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                  const Vec3& eb1, double eps_x) {
  return mollifier_value(edge_edge_cross_squared(ea0, ea1, eb0, eb1), eps_x);
}

inline StencilGradient<12> edge_edge_mollifier_gradient(const Vec3& ea0, const Vec3& ea1,
                                                        const Vec3& eb0, const Vec3& eb1,
                                                        double eps_x) {
  const auto [c, gradient] = edge_edge_cross_squared_gradient(ea0, ea1, eb0, eb1);
  return {mollifier_value(c, eps_x), mollifier_slope(c, eps_x) * gradient};
}

StencilDerivatives<12> edge_edge_mollifier_derivatives(const Vec3& ea0, const Vec3& ea1,
                                                       const Vec3& eb0, const Vec3& eb1,
                                                       double eps_x);

}  // namespace tack
