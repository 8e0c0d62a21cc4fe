#include "geometry/distance/point_line.hpp"

namespace tack {

StencilDerivatives<9> point_line_derivatives(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  const auto [u, r] = project_onto_line(p, e0, e1);
  const Vec3 w(1.0, u - 1.0, -u);
  const Vec3 slope(0.0, 1.0, -1.0);
  const auto [s, gradient] = squared_length<3>(w, r);
  StencilDerivatives<9> out{s, gradient, {}};

  const Vec3 e = e1 - e0;
  const double inverse = 1.0 / e.squaredNorm();
  const Vec3 q = -inverse * e;
  const Mat3 projector = 2.0 * Mat3::Identity() - (2.0 * inverse * e) * e.transpose();
  const Vec9 turn = stacked<3>(2.0 * slope, r);
  const Vec9 slide = stacked<3>(2.0 * w, q);
  for (int j = 0; j < 3; ++j) {
    const Vec3 mixed = w[j] * q + (slope[j] * inverse) * r;
    for (int k = 0; k < 3; ++k) {
      out.hessian.col(3 * j + k) =
          w[j] * stacked<3>(w, projector.col(k)) - mixed[k] * turn - (slope[j] * r[k]) * slide;
    }
  }
  return out;
}

}  // namespace tack
