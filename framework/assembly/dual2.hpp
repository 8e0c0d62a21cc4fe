// Second-order forward-mode number in one variable: value, first and second derivative. A law
// written as one formula, `template <class T> T energy(const T& d) const`, gets exact derivatives
// from it.
#pragma once

#include <cmath>

namespace tack {

/// A value with its first and second derivative.
struct Dual2 {
  double v = 0, d1 = 0, d2 = 0;

  Dual2() = default;
  Dual2(double value) : v(value) {}  // a constant
  Dual2(double value, double first, double second) : v(value), d1(first), d2(second) {}
  static Dual2 variable(double value) { return {value, 1.0, 0.0}; }

  /// Returns f(*this), given f, f' and f'' at v.
  Dual2 chain(double f, double f1, double f2) const { return {f, f1 * d1, f2 * d1 * d1 + f1 * d2}; }
};

inline Dual2 operator-(const Dual2& a) { return {-a.v, -a.d1, -a.d2}; }
inline Dual2 operator+(const Dual2& a, const Dual2& b) {
  return {a.v + b.v, a.d1 + b.d1, a.d2 + b.d2};
}
inline Dual2 operator-(const Dual2& a, const Dual2& b) {
  return {a.v - b.v, a.d1 - b.d1, a.d2 - b.d2};
}
inline Dual2 operator*(const Dual2& a, const Dual2& b) {
  return {a.v * b.v, a.d1 * b.v + a.v * b.d1, a.d2 * b.v + 2 * a.d1 * b.d1 + a.v * b.d2};
}
inline Dual2 reciprocal(const Dual2& a) {
  const double r = 1 / a.v;
  return a.chain(r, -r * r, 2 * r * r * r);
}
inline Dual2 operator/(const Dual2& a, const Dual2& b) { return a * reciprocal(b); }
inline bool operator<(const Dual2& a, const Dual2& b) { return a.v < b.v; }
inline bool operator>(const Dual2& a, const Dual2& b) { return a.v > b.v; }

inline Dual2 log(const Dual2& a) { return a.chain(std::log(a.v), 1 / a.v, -1 / (a.v * a.v)); }
inline Dual2 exp(const Dual2& a) {
  const double e = std::exp(a.v);
  return a.chain(e, e, e);
}
inline Dual2 sqrt(const Dual2& a) {
  const double r = std::sqrt(a.v);
  return a.chain(r, 0.5 / r, -0.25 / (r * a.v));
}
inline Dual2 pow(const Dual2& a, double p) {
  const double f = std::pow(a.v, p);
  return a.chain(f, p * f / a.v, p * (p - 1) * f / (a.v * a.v));
}
inline Dual2 sin(const Dual2& a) { return a.chain(std::sin(a.v), std::cos(a.v), -std::sin(a.v)); }
inline Dual2 cos(const Dual2& a) { return a.chain(std::cos(a.v), -std::sin(a.v), -std::cos(a.v)); }
inline Dual2 tanh(const Dual2& a) {
  const double t = std::tanh(a.v), s = 1 - t * t;
  return a.chain(t, s, -2 * t * s);
}

}  // namespace tack
