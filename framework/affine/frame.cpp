#include "framework/affine/frame.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "geometry/errors.hpp"

namespace tack {

BodyFrame body_frame(const MassProperties& body) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(body.moments / body.volume);
  const Vec3& squares = solver.eigenvalues();
  constexpr double flat = 1e-12;
  if (!(body.volume > 0) || !(squares(0) > flat * squares(2))) throw InputError("is flat: an affine body needs a volume");
  Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  constexpr int sigma[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}};
  BodyFrame frame;
  for (int i = 0; i < 4; ++i) {
    frame.vertices[i] = body.centroid;
    for (int k = 0; k < 3; ++k) frame.vertices[i] += sigma[i][k] * std::sqrt(squares(k)) * axes.col(k);
  }
  return frame;
}

}  // namespace tack
