#include "geometry/distance/line_line.hpp"

namespace tack {

StencilDerivatives<12> line_line_derivatives(const Vec3& ea0, const Vec3& ea1,
                                             const Vec3& eb0, const Vec3& eb1) {
  const PlaneProjection plane = project_line_onto_line(ea0, ea1, eb0, eb1);
  const Eigen::Vector4d w = line_line_weights(plane);
  Eigen::Matrix<double, 3, 4> duals;
  duals.col(0) = -plane.dual_a;
  duals.col(1) = plane.dual_a;
  duals.col(2) = plane.dual_b;
  duals.col(3) = -plane.dual_b;
  const auto [s, gradient] = squared_length<4>(w, plane.residual);
  return {s, gradient, plane_hessian(w, duals, plane)};
}

}  // namespace tack
