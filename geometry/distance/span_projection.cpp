#include "geometry/distance/span_projection.hpp"

namespace tack {

Mat12 plane_hessian(const Eigen::Vector4d& w, const Eigen::Matrix<double, 3, 4>& duals,
                    const PlaneProjection& plane) {
  const Vec3& n = plane.normal;
  const double height = plane.inverse * n.dot(plane.residual);  // h / |n|, n not normalised
  const Eigen::Matrix4d gram = duals.transpose() * duals;
  const Eigen::Matrix4d along_normal =
      (2.0 * plane.inverse) * (w * w.transpose() - plane.residual.squaredNorm() * gram);
  Eigen::Matrix<double, 12, 3> normal_terms;  // block i is 2 h n q_i^T
  for (int i = 0; i < 4; ++i) {
    normal_terms.middleRows<3>(3 * i) = (2.0 * height * n) * duals.col(i).transpose();
  }
  Mat12 hessian;
  for (int j = 0; j < 4; ++j) {
    const Vec12 column =
        stacked<4>(along_normal.col(j), n) - stacked<4>((2.0 * height) * w, duals.col(j));
    for (int k = 0; k < 3; ++k) hessian.col(3 * j + k) = n[k] * column - w[j] * normal_terms.col(k);
  }
  return hessian;
}

}  // namespace tack
