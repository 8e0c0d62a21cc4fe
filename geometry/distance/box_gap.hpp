// Gaps between the AABBs of two primitives along each axis [m]; negative along axes in which they
// overlap. The largest gap, and the norm of the positive gaps, are cheap lower bounds of the
// distance.
#pragma once

#include "geometry/types.hpp"

namespace tack {

template <size_t A, size_t B>
Vec3 box_gaps(const std::array<Vec3, A>& a, const std::array<Vec3, B>& b) {
  Vec3 low_a = a[0], high_a = a[0], low_b = b[0], high_b = b[0];
  for (size_t i = 1; i < A; ++i) low_a = low_a.cwiseMin(a[i]), high_a = high_a.cwiseMax(a[i]);
  for (size_t i = 1; i < B; ++i) low_b = low_b.cwiseMin(b[i]), high_b = high_b.cwiseMax(b[i]);
  return (low_b - high_a).cwiseMax(low_a - high_b);
}

}  // namespace tack
