// 3x3 blocks, column major, in registers of four numbers of which three count: the compiler's own
// vectors, so that no instruction set is assumed.
#pragma once

#include <cstring>

namespace tack {

using Lanes = double __attribute__((vector_size(32)));

/// Load four numbers.
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
/// Reads three: they may be the last of an array.
template <class T>
Lanes load3(const T* p) {
  return Lanes{p[0], p[1], p[2], 0};
}
/// Write three or four numbers.
inline void store3(const Lanes& lanes, double* p) {
  for (int d = 0; d < 3; ++d) p[d] = lanes[d];
}
inline void store4(const Lanes& lanes, double* p) { std::memcpy(p, &lanes, sizeof lanes); }
/// Returns the sum of the first three lanes.
inline double sum3(const Lanes& lanes) { return lanes[0] + lanes[1] + lanes[2]; }
/// Returns lane d in all lanes.
template <int d>
Lanes spread(const Lanes& lanes) {
  return __builtin_shufflevector(lanes, lanes, d, d, d, d);
}

/// Returns the lanes 1, 2, 3, 0.
inline Lanes rotated(const Lanes& lanes) {
  return __builtin_shufflevector(lanes, lanes, 1, 2, 3, 0);
}

/// Returns the cross product of the first three lanes.
inline Lanes cross(const Lanes& a, const Lanes& b) {
  const auto next = [](const Lanes& v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
  const auto last = [](const Lanes& v) { return __builtin_shufflevector(v, v, 2, 0, 1, 3); };
  return next(a) * last(b) - last(a) * next(b);
}

/// The columns of a block. The fourth lane is that of another column.
struct BlockLanes {
  BlockLanes() : a{}, b{}, c{} {}
  template <class T>
  explicit BlockLanes(const T* block)
      : a(load4(block)), b(load4(block + 3)), c(rotated(load4(block + 5))) {}
  BlockLanes(const Lanes& x, const Lanes& y, const Lanes& z) : a(x), b(y), c(z) {}
  /// Reads the number after the block as well.
  template <class T>
  static BlockLanes padded(const T* block) {
    return {load4(block), load4(block + 3), load4(block + 6)};
  }
  Lanes times(const double* v) const { return a * v[0] + b * v[1] + c * v[2]; }
  Lanes times(const Lanes& v) const {
    return a * spread<0>(v) + b * spread<1>(v) + c * spread<2>(v);
  }
  Lanes times(const Lanes& v, const Lanes& start) const {
    return start + a * spread<0>(v) + b * spread<1>(v) + c * spread<2>(v);
  }
  inline Lanes transposed_times(const Lanes& v) const;
  /// This times the transpose of another block.
  BlockLanes times_transposed(const double* other) const {
    const auto column = [&](int j) { return a * other[j] + b * other[j + 3] + c * other[j + 6]; };
    return {column(0), column(1), column(2)};
  }
  /// The matrix of the cross product with v, times this; and this times that matrix.
  BlockLanes crossed_by(const Lanes& v) const { return {cross(v, a), cross(v, b), cross(v, c)}; }
  BlockLanes times_cross(const Lanes& v) const {
    return {b * spread<2>(v) - c * spread<1>(v), c * spread<0>(v) - a * spread<2>(v),
            a * spread<1>(v) - b * spread<0>(v)};
  }
  BlockLanes transposed() const {
    return {Lanes{a[0], b[0], c[0], 0}, Lanes{a[1], b[1], c[1], 0}, Lanes{a[2], b[2], c[2], 0}};
  }
  void operator*=(double factor) { a *= factor, b *= factor, c *= factor; }
  void operator+=(const BlockLanes& other) {
    a += other.a;
    b += other.b;
    c += other.c;
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

/// Sums products of transposed blocks with vectors, lane by lane until the end.
struct TransposedSum {
  void add(const BlockLanes& block, const Lanes& v) {
    a += block.a * v;
    b += block.b * v;
    c += block.c * v;
  }
  Lanes sum() const {
    const Lanes ab = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                ab1 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Lanes first = __builtin_shufflevector(ab, c, 0, 1, 4, 5),
                third = __builtin_shufflevector(ab, c, 2, 3, 6, 7);
    return first + __builtin_shufflevector(ab1, c, 0, 1, 5, 6) + third;
  }
  Lanes a{}, b{}, c{};
};

inline Lanes BlockLanes::transposed_times(const Lanes& v) const {
  TransposedSum sum;
  sum.add(*this, v);
  return sum.sum();
}

}  // namespace tack
