// Integer kernels of the overlap search, on eight ids at a time. They have no branch that depends
// on the lanes that are hit: hits are random, and mispredictions cost more than the tests.
#pragma once

#include <algorithm>
#include <bit>
#include <limits>

#if defined(__AVX512VL__) || defined(__AVX2__)
#include <immintrin.h>
#endif

namespace tack::detail {

// Returns a mask; bit i is set if ids[i] > id.
inline unsigned lanes_above(const int* ids, int id) {
#if defined(__AVX2__)
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids));
  const __m256i above = _mm256_cmpgt_epi32(all, _mm256_set1_epi32(id));
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(above)));
#else
  unsigned mask = 0;
  for (int i = 0; i < 8; ++i) mask |= static_cast<unsigned>(ids[i] > id) << i;
  return mask;
#endif
}

// Writes the ids of the lanes in the mask, in order, and returns the end. `out` must have space for
// eight.
inline int* append_lanes(const int* ids, unsigned mask, int* out) {
#if defined(__AVX512VL__)
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids));
  const __m256i packed = _mm256_maskz_compress_epi32(static_cast<__mmask8>(mask), all);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), packed);
  return out + std::popcount(mask);
#else
  for (int i = 0; i < 8; ++i) {
    *out = ids[i];
    out += mask >> i & 1u;
  }
  return out;
#endif
}

// Sorts distinct ids. Short lists are sorted by rank: the number of smaller ids.
inline void sort_distinct(int* ids, int count) {
  constexpr int few = 32, block = 8;
  if (count > few) {
    std::sort(ids, ids + count);
    return;
  }
  int unsorted[few];
  std::fill(unsorted, unsorted + few, std::numeric_limits<int>::max());
  std::copy(ids, ids + count, unsorted);
  for (int i = 0; i < count; ++i) {
    int rank = 0;
    for (int first = 0; first < count; first += block)
      for (int k = 0; k < block; ++k) rank += unsorted[first + k] < unsorted[i];
    ids[rank] = unsorted[i];
  }
}

}  // namespace tack::detail
