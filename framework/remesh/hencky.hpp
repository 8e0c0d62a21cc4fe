// Hencky strain of a deformation F in space, ln(F F^T) / 2, and its inverse. Stress and stored
// energy of an isotropic material depend on F by this strain alone. Where the stress is linear in
// it, a mean of strains has the mean stress.
#pragma once

#include <Eigen/Eigenvalues>

#include "geometry/types.hpp"

namespace tack {

// Returns the matrix with the same eigenvectors and the eigenvalues f(eigenvalue).
template <class Function>
Mat3 apply_to_eigenvalues(const Mat3& symmetric, const Function& f) {
  const Eigen::SelfAdjointEigenSolver<Mat3> s(symmetric);
  Vec3 values;
  for (int i = 0; i < 3; ++i) values(i) = f(s.eigenvalues()(i));
  return s.eigenvectors() * values.asDiagonal() * s.eigenvectors().transpose();
}

inline Mat3 hencky_strain(const Mat3& f) {
  return apply_to_eigenvalues(f * f.transpose(),
                              [](double square) { return std::log(square) / 2; });
}

// Returns the stretch (no rotation) of a Hencky strain.
inline Mat3 stretch_of(const Mat3& strain) {
  return apply_to_eigenvalues(strain, [](double e) { return std::exp(e); });
}

}  // namespace tack
