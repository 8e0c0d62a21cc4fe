// Pack of the numbers of several elements, one per lane, as a scalar type of Eigen's fixed-size
// matrices. Code written for numbers then computes several elements at a time, by the compiler's
// vector types, without assuming an instruction set. Lanes do not mix and never branch: `select`
// chooses between results.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

namespace tack {

// Namespace by width, so that types of different widths are different types.
#if defined(__AVX512F__)
inline namespace packs_of_8 {
inline constexpr int pack_width = 8;
#elif defined(__AVX__)
inline namespace packs_of_4 {
inline constexpr int pack_width = 4;
#else
inline namespace packs_of_2 {
inline constexpr int pack_width = 2;
#endif

// Mask: all bits or none per lane.
using PackMask = long long __attribute__((vector_size(8 * pack_width)));

inline bool any(const PackMask& mask) {
  long long all = 0;
  for (int l = 0; l < pack_width; ++l) all |= mask[l];
  return all != 0;
}

class Pack {
 public:
  using Vector = double __attribute__((vector_size(8 * pack_width)));

  Pack() = default;
  Pack(double x) : v_(x - Vector{}) {}  // in every lane
  explicit Pack(const Vector& v) : v_(v) {}

  const Vector& vector() const { return v_; }
  double operator[](int lane) const { return v_[lane]; }
  void set(int lane, double x) { v_[lane] = x; }

  friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.v_ + b.v_); }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.v_ - b.v_); }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.v_ * b.v_); }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v_ / b.v_); }
  Pack operator-() const { return Pack(-v_); }
  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  Pack& operator-=(const Pack& b) { return *this = *this - b; }
  Pack& operator*=(const Pack& b) { return *this = *this * b; }
  Pack& operator/=(const Pack& b) { return *this = *this / b; }

  friend PackMask operator<(const Pack& a, const Pack& b) { return a.v_ < b.v_; }
  friend PackMask operator<=(const Pack& a, const Pack& b) { return a.v_ <= b.v_; }
  friend PackMask operator>(const Pack& a, const Pack& b) { return a.v_ > b.v_; }

  friend Pack select(const PackMask& mask, const Pack& yes, const Pack& no) {
    return Pack(mask ? yes.v_ : no.v_);
  }
  friend Pack abs(const Pack& a) { return select(a < 0, -a, a); }
  friend Pack sqrt(const Pack& a) {
    return each_lane(a, [](double x) { return std::sqrt(x); });
  }
  friend Pack log(const Pack& a) {
    return each_lane(a, [](double x) { return std::log(x); });
  }
  // Returns the angle of finite numbers, with an error of at most four roundings; zeros count as
  // +0. Method: reduction to arcs of at most pi/8, and a polynomial in t^2 for atan(t) / t that is
  // exact at Chebyshev points.
  friend Pack atan2(const Pack& y, const Pack& x) {
    constexpr double quarter = 0.78539816339744830962;  // pi / 4
    constexpr double p[] = {1.0,
                            -0.33333333333328435,
                            0.19999999998854168,
                            -0.14285714180900647,
                            0.11111106177375227,
                            -0.09090773003240828,
                            0.07689952488233016,
                            -0.066402251735395,
                            0.0568830340363325,
                            -0.043479198390465365,
                            0.02113375203374836};
    const Pack ax = abs(x), ay = abs(y);
    const PackMask upright = ax < ay;
    const Pack small = select(upright, ax, ay), big = select(upright, ay, ax);
    const PackMask steep = 0.41421356237309503 * big < small;
    const Pack over = select(steep, small - big, small), under = select(steep, small + big, big);
    const Pack t = over / select(under <= 0, 1, under), z = t * t;
    Pack sum = p[10];
    for (int k = 9; k >= 0; --k) sum = sum * z + p[k];
    Pack angle = select(steep, Pack(quarter), 0) + t * sum;
    angle = select(upright, 2 * quarter - angle, angle);
    angle = select(x < 0, 4 * quarter - angle, angle);
    return select(y < 0, -angle, angle);
  }
  friend Pack log1p(const Pack& a) {
    return each_lane(a, [](double x) { return std::log1p(x); });
  }

 private:
  template <class F>
  static Pack each_lane(const Pack& a, const F& f) {
    Pack out;
    for (int l = 0; l < pack_width; ++l) out.v_[l] = f(a.v_[l]);
    return out;
  }

  Vector v_;
};

}  // inline namespace

namespace detail {
// One step of a recursive transposition: swaps lane l of row i with lane l ^ h of row i ^ h.
template <int h, int... l>
[[gnu::always_inline]] inline void exchange(Pack::Vector (&rows)[pack_width],
                                            std::integer_sequence<int, l...>) {
  for (int i = 0; i < pack_width; ++i) {
    if (i & h) continue;
    const Pack::Vector a = rows[i], b = rows[i + h];
    rows[i] = __builtin_shufflevector(a, b, (l & h ? pack_width + l - h : l)...);
    rows[i + h] = __builtin_shufflevector(a, b, (l & h ? pack_width + l : l + h)...);
  }
}
}  // namespace detail

[[gnu::always_inline]] inline void transpose(Pack::Vector (&rows)[pack_width]) {
  constexpr std::make_integer_sequence<int, pack_width> lanes;
  detail::exchange<1>(rows, lanes);
  if constexpr (pack_width >= 4) detail::exchange<2>(rows, lanes);
  if constexpr (pack_width == 8) detail::exchange<4>(rows, lanes);
}

// Overloads for plain numbers, for generic functions.
inline bool any(bool mask) { return mask; }
inline double select(bool mask, double yes, double no) { return mask ? yes : no; }

template <int Rows, int Columns = 1>
using PackMatrix = Eigen::Matrix<Pack, Rows, Columns>;
using PackVec3 = PackMatrix<3>;
using PackMat3 = PackMatrix<3, 3>;

template <int Rows, int Columns>
void set_lane(PackMatrix<Rows, Columns>& pack, int lane,
              const Eigen::Matrix<double, Rows, Columns>& m) {
  for (int i = 0; i < Rows * Columns; ++i) pack(i).set(lane, m(i));
}
template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> get_lane(const PackMatrix<Rows, Columns>& pack, int lane) {
  Eigen::Matrix<double, Rows, Columns> m;
  for (int i = 0; i < Rows * Columns; ++i) m(i) = pack(i)[lane];
  return m;
}

// Stores out[count * l + i] = packs[i][l] for the first `lanes` lanes: consecutive arrays of
// `count` numbers.
inline void store_lanes(const Pack* packs, int count, double* out, int lanes) {
  if (count < pack_width) {
    for (int l = 0; l < lanes; ++l)
      for (int i = 0; i < count; ++i) *out++ = packs[i][l];
    return;
  }
  for (int first = 0; first < count; first += pack_width) {
    const int at = std::min(first, count - pack_width);  // the last rows overlap
    Pack::Vector rows[pack_width];
    for (int i = 0; i < pack_width; ++i) rows[i] = packs[at + i].vector();
    transpose(rows);
    for (int l = 0; l < lanes; ++l)
      std::memcpy(out + std::ptrdiff_t(count) * l + at, &rows[l], sizeof rows[l]);
  }
}

}  // namespace tack

template <>
struct Eigen::NumTraits<tack::Pack> : Eigen::GenericNumTraits<double> {
  using Real = tack::Pack;
  using NonInteger = tack::Pack;
  using Nested = tack::Pack;
};
