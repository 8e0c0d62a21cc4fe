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
inline void store4(const Lanes& lanes, double* p) { std::memcpy(p, &lanes, sizeof lanes); }
inline double sum3(const Lanes& lanes) { return lanes[0] + lanes[1] + lanes[2]; }

// The columns of a block. The fourth lane is that of another column.
struct BlockLanes {
  template <class T>
  explicit BlockLanes(const T* block) : a(load4(block)), b(load4(block + 3)), c(load3(block + 6)) {}
  BlockLanes(const Lanes& x, const Lanes& y, const Lanes& z) : a(x), b(y), c(z) {}
  // Reads the number after the block as well.
  template <class T>
  static BlockLanes padded(const T* block) {
    return {load4(block), load4(block + 3), load4(block + 6)};
  }
  Lanes times(const double* v) const { return a * v[0] + b * v[1] + c * v[2]; }
  // This times the transpose of another block.
  BlockLanes times_transposed(const double* other) const {
    const auto column = [&](int j) { return a * other[j] + b * other[j + 3] + c * other[j + 6]; };
    return {column(0), column(1), column(2)};
  }
  void operator-=(const BlockLanes& other) {
    a -= other.a;
    b -= other.b;
    c -= other.c;
  }
  void store(double* block) const {
    store3(a, block);
    store3(b, block + 3);
    store3(c, block + 6);
  }
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
