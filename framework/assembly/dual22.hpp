// Second-order forward-mode number in two variables: value, gradient (a, b) and Hessian (aa, ab,
// bb). A law written as one formula, `template <class T> T energy(const T& d, const T& s, ...)
// const`, gets exact derivatives from it.
#pragma once

#include <cmath>

namespace tack {

/// A value with its first and second derivatives in two variables.
struct Dual22 {
  double v = 0, a = 0, b = 0, aa = 0, ab = 0, bb = 0;

  Dual22() = default;
  Dual22(double value) : v(value) {}  // a constant
  Dual22(double value, double first, double second, double first2 = 0, double mixed = 0,
         double second2 = 0)
      : v(value), a(first), b(second), aa(first2), ab(mixed), bb(second2) {}
  static Dual22 first(double value) { return {value, 1, 0}; }
  static Dual22 second(double value) { return {value, 0, 1}; }

  /// Returns f(*this), given f, f' and f'' at v.
  Dual22 chain(double f, double f1, double f2) const {
    return {f, f1 * a, f1 * b, f2 * a * a + f1 * aa, f2 * a * b + f1 * ab, f2 * b * b + f1 * bb};
  }
};

inline Dual22 operator-(const Dual22& x) { return {-x.v, -x.a, -x.b, -x.aa, -x.ab, -x.bb}; }
inline Dual22 operator+(const Dual22& x, const Dual22& y) {
  return {x.v + y.v, x.a + y.a, x.b + y.b, x.aa + y.aa, x.ab + y.ab, x.bb + y.bb};
}
inline Dual22 operator-(const Dual22& x, const Dual22& y) {
  return {x.v - y.v, x.a - y.a, x.b - y.b, x.aa - y.aa, x.ab - y.ab, x.bb - y.bb};
}
inline Dual22 operator*(const Dual22& x, const Dual22& y) {
  return {x.v * y.v,
          x.a * y.v + x.v * y.a,
          x.b * y.v + x.v * y.b,
          x.aa * y.v + 2 * x.a * y.a + x.v * y.aa,
          x.ab * y.v + x.a * y.b + x.b * y.a + x.v * y.ab,
          x.bb * y.v + 2 * x.b * y.b + x.v * y.bb};
}
inline Dual22 reciprocal(const Dual22& x) {
  const double r = 1 / x.v;
  return x.chain(r, -r * r, 2 * r * r * r);
}
inline Dual22 operator/(const Dual22& x, const Dual22& y) { return x * reciprocal(y); }
inline bool operator<(const Dual22& x, const Dual22& y) { return x.v < y.v; }
inline bool operator>(const Dual22& x, const Dual22& y) { return x.v > y.v; }

inline Dual22 log(const Dual22& x) { return x.chain(std::log(x.v), 1 / x.v, -1 / (x.v * x.v)); }
inline Dual22 exp(const Dual22& x) {
  const double e = std::exp(x.v);
  return x.chain(e, e, e);
}
/// At 0, where the root has no derivative, the derivative is 0: laws are even in such arguments.
inline Dual22 sqrt(const Dual22& x) {
  const double r = std::sqrt(x.v);
  return r > 0 ? x.chain(r, 0.5 / r, -0.25 / (r * x.v)) : Dual22();
}
inline Dual22 pow(const Dual22& x, double p) {
  const double f = std::pow(x.v, p);
  return x.chain(f, p * f / x.v, p * (p - 1) * f / (x.v * x.v));
}
inline Dual22 sin(const Dual22& x) { return x.chain(std::sin(x.v), std::cos(x.v), -std::sin(x.v)); }
inline Dual22 cos(const Dual22& x) {
  return x.chain(std::cos(x.v), -std::sin(x.v), -std::cos(x.v));
}
inline Dual22 tanh(const Dual22& x) {
  const double t = std::tanh(x.v), s = 1 - t * t;
  return x.chain(t, s, -2 * t * s);
}

/// Returns f(x) for a formula with known derivatives: f, f' and f'' at value_of(x).
inline double value_of(double x) { return x; }
inline double value_of(const Dual22& x) { return x.v; }
inline double chained(double, double f, double, double) { return f; }
inline Dual22 chained(const Dual22& x, double f, double f1, double f2) {
  return x.chain(f, f1, f2);
}

}  // namespace tack
