// 3x3 blocks, column major, in registers of four numbers of which three count: the compiler's own
// vectors, so that no instruction set is assumed.
#pragma once

#include <cstring>

namespace tack {

using Lanes = double __attribute__((vector_size(32)));

inline Lanes load4(const double* p) {
  Lanes lanes;
  std::memcpy(&lanes, p, sizeof lanes);
  return lanes;
}
inline Lanes load4(const float* p) {
  float __attribute__((vector_size(16))) lanes;
  std::memcpy(&lanes, p, sizeof lanes);
  return __builtin_convertvector(lanes, Lanes);
}
// Reads three: they may be the last of an array.
template <class T>
Lanes load3(const T* p) {
  return Lanes{p[0], p[1], p[2], 0};
}
inline void store3(const Lanes& lanes, double* p) {
  for (int d = 0; d < 3; ++d) p[d] = lanes[d];
}
inline double sum3(const Lanes& lanes) { return lanes[0] + lanes[1] + lanes[2]; }

// The columns of a block. The fourth lane is that of another column.
struct BlockLanes {
  template <class T>
  explicit BlockLanes(const T* block) : a(load4(block)), b(load4(block + 3)), c(load3(block + 6)) {}
  Lanes times(const double* v) const { return a * v[0] + b * v[1] + c * v[2]; }
  Lanes transposed_times(const Lanes& v) const { return Lanes{sum3(a * v), sum3(b * v), sum3(c * v), 0}; }
  Lanes a, b, c;
};

// Sums products of transposed blocks with vectors, lane by lane until the end.
struct TransposedSum {
  void add(const BlockLanes& block, const Lanes& v) {
    a += block.a * v;
    b += block.b * v;
    c += block.c * v;
  }
  Lanes sum() const { return Lanes{sum3(a), sum3(b), sum3(c), 0}; }
  Lanes a{}, b{}, c{};
};

}  // namespace tack
