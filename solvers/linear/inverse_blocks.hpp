// Inverse of a symmetric positive definite 3x3 block.
#pragma once

#include <Eigen/Cholesky>

#include "geometry/types.hpp"

namespace tack {

// Inverts a block by its Cholesky factor. Returns false, with no result, if the block is not
// positive definite. Cofactors would not do: contact makes blocks of condition 1e8, whose inverses
// must be definite.
inline bool invert_definite(const Mat3& block, Mat3& inverse) {
  const Eigen::LLT<Mat3> factor(block);
  if (factor.info() != Eigen::Success) return false;
  inverse = factor.solve(Mat3::Identity());
  inverse = 0.5 * (inverse + inverse.transpose()).eval();
  return inverse.allFinite();
}

}  // namespace tack
