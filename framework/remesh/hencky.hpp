// Hencky's strain of a deformation F as seen in space, ln(F F^T) / 2, and back. Stress and stored
// energy of an isotropic material know no more of F, and where they are those of Hencky's strain,
// means of strains have the mean stress.
#pragma once

#include <Eigen/Eigenvalues>

#include "geometry/types.hpp"

namespace tack {

template <class Function>
Mat3 of_eigenvalues(const Mat3& symmetric, const Function& f) {
  const Eigen::SelfAdjointEigenSolver<Mat3> s(symmetric);
  Vec3 values;
  for (int i = 0; i < 3; ++i) values(i) = f(s.eigenvalues()(i));
  return s.eigenvectors() * values.asDiagonal() * s.eigenvectors().transpose();
}

inline Mat3 hencky_strain(const Mat3& f) {
  return of_eigenvalues(f * f.transpose(), [](double square) { return std::log(square) / 2; });
}

// Returns the stretch, without a rotation, of a Hencky strain.
inline Mat3 stretch_of(const Mat3& strain) {
  return of_eigenvalues(strain, [](double e) { return std::exp(e); });
}

}  // namespace tack
