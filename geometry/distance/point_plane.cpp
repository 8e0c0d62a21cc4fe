#include "geometry/distance/point_plane.hpp"

namespace tack {

StencilDerivatives<12> point_plane_derivatives(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                               const Vec3& t2) {
  const PlaneProjection plane = project_onto_triangle(p, t0, t1, t2);
  const Eigen::Vector4d w = point_plane_weights(plane);
  Eigen::Matrix<double, 3, 4> duals;
  duals.col(0).setZero();
  duals.col(1) = plane.dual_a + plane.dual_b;
  duals.col(2) = -plane.dual_a;
  duals.col(3) = -plane.dual_b;
  const auto [s, gradient] = squared_length<4>(w, plane.residual);
  return {s, gradient, plane_hessian(w, duals, plane)};
}

}  // namespace tack
