// Inverse of a symmetric positive definite 3x3 block; false, and no result, if it is not definite.
#pragma once

#include <Eigen/Cholesky>

#include "geometry/types.hpp"

namespace tack {

// By the Cholesky factor rather than cofactors: a contact makes blocks of condition 1e8, and their
// inverses must come out definite.
inline bool invert_definite(const Mat3& block, Mat3& inverse) {
  const Eigen::LLT<Mat3> factor(block);
  if (factor.info() != Eigen::Success) return false;
  inverse = factor.solve(Mat3::Identity());
  inverse = 0.5 * (inverse + inverse.transpose()).eval();
  return inverse.allFinite();
}

}  // namespace tack
