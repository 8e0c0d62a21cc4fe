// A stencil's Hessian as slots of 3x3 blocks, lower triangle by rows (see Term).
#pragma once

#include "geometry/types.hpp"

namespace tack {

template <int K>
void store_blocks(const Eigen::Matrix<double, 3 * K, 3 * K>& h, double* out) {
  for (int i = 0; i < K; ++i)
    for (int j = 0; j <= i; ++j, out += 9)
      Eigen::Map<Mat3>{out} = h.template block<3, 3>(3 * i, 3 * j);
}

template <int K>
void load_blocks(const double* in, Eigen::Matrix<double, 3 * K, 3 * K>& h) {
  for (int i = 0; i < K; ++i) {
    for (int j = 0; j <= i; ++j, in += 9) {
      h.template block<3, 3>(3 * i, 3 * j) = Eigen::Map<const Mat3>(in);
      h.template block<3, 3>(3 * j, 3 * i) = Eigen::Map<const Mat3>(in).transpose();
    }
  }
}

}  // namespace tack
