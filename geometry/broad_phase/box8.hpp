// Eight boxes side by side (structure of arrays): one box is tested against all of them with a few
// vector comparisons. Empty lanes have lo = +inf, hi = -inf and overlap no box.
#pragma once

#include "geometry/broad_phase/aabb.hpp"

#if defined(__AVX512F__) || defined(__AVX__)
#include <immintrin.h>
#endif

namespace tack {

struct Box8 {
  static constexpr int width = 8;

  alignas(64) double lo[3][width];
  alignas(64) double hi[3][width];

  void set(int lane, const Aabb& box) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis][lane] = box.lo[axis];
      hi[axis][lane] = box.hi[axis];
    }
  }
  Aabb get(int lane) const {
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = lo[axis][lane];
      box.hi[axis] = hi[axis][lane];
    }
    return box;
  }
  // Returns a mask; bit i is set if box i overlaps `box`. Compilers do not vectorise the plain
  // loop, which is several times slower.
  unsigned overlap_mask(const Aabb& box) const {
#if defined(__AVX512F__)
    __mmask8 mask = 0xff;
    for (int axis = 0; axis < 3; ++axis) {
      const __m512d box_hi = _mm512_set1_pd(box.hi[axis]), box_lo = _mm512_set1_pd(box.lo[axis]);
      mask = _mm512_mask_cmp_pd_mask(mask, _mm512_load_pd(lo[axis]), box_hi, _CMP_LE_OQ);
      mask = _mm512_mask_cmp_pd_mask(mask, _mm512_load_pd(hi[axis]), box_lo, _CMP_GE_OQ);
    }
    return mask;
#elif defined(__AVX__)
    return half_mask(box, 0) | half_mask(box, 4) << 4;
#else
    unsigned mask = 0;
    for (int i = 0; i < width; ++i) {
      bool hit = true;
      for (int axis = 0; axis < 3; ++axis)
        hit &= (lo[axis][i] <= box.hi[axis]) & (hi[axis][i] >= box.lo[axis]);
      mask |= static_cast<unsigned>(hit) << i;
    }
    return mask;
#endif
  }

 private:
#if defined(__AVX__) && !defined(__AVX512F__)
  unsigned half_mask(const Aabb& box, int first) const {
    __m256d hit = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
    for (int axis = 0; axis < 3; ++axis) {
      const __m256d box_hi = _mm256_set1_pd(box.hi[axis]), box_lo = _mm256_set1_pd(box.lo[axis]);
      hit = _mm256_and_pd(hit, _mm256_cmp_pd(_mm256_load_pd(lo[axis] + first), box_hi, _CMP_LE_OQ));
      hit = _mm256_and_pd(hit, _mm256_cmp_pd(_mm256_load_pd(hi[axis] + first), box_lo, _CMP_GE_OQ));
    }
    return static_cast<unsigned>(_mm256_movemask_pd(hit));
  }
#endif
};

}  // namespace tack
