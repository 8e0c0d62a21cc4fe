// Second-order forward-mode number in three variables: value, gradient and Hessian. A bond law that
// is a formula of the opening and both components of the slip gets exact derivatives from it.
#pragma once

#include <cmath>

#include "geometry/types.hpp"

namespace tack {

/// A value with its first and second derivatives in three variables.
struct Dual23 {
  double v = 0;
  Vec3 g = Vec3::Zero();
  Mat3 h = Mat3::Zero();

  Dual23() = default;
  Dual23(double value) : v(value) {}  // a constant
  Dual23(double value, const Vec3& gradient, const Mat3& hessian)
      : v(value), g(gradient), h(hessian) {}
  static Dual23 variable(int k, double value) { return {value, Vec3::Unit(k), Mat3::Zero()}; }

  /// Returns f(*this), given f, f' and f'' at v.
  Dual23 chain(double f, double f1, double f2) const {
    return {f, f1 * g, f2 * g * g.transpose() + f1 * h};
  }
};

inline Dual23 operator-(const Dual23& x) { return {-x.v, -x.g, -x.h}; }
inline Dual23 operator+(const Dual23& x, const Dual23& y) {
  return {x.v + y.v, x.g + y.g, x.h + y.h};
}
inline Dual23 operator-(const Dual23& x, const Dual23& y) {
  return {x.v - y.v, x.g - y.g, x.h - y.h};
}
inline Dual23 operator*(const Dual23& x, const Dual23& y) {
  return {x.v * y.v, x.v * y.g + y.v * x.g,
          x.v * y.h + y.v * x.h + x.g * y.g.transpose() + y.g * x.g.transpose()};
}
inline Dual23 operator/(const Dual23& x, const Dual23& y) {
  const double r = 1 / y.v;
  return x * y.chain(r, -r * r, 2 * r * r * r);
}
inline bool operator<(const Dual23& x, const Dual23& y) { return x.v < y.v; }
inline bool operator>(const Dual23& x, const Dual23& y) { return x.v > y.v; }

inline Dual23 exp(const Dual23& x) {
  const double e = std::exp(x.v);
  return x.chain(e, e, e);
}
inline Dual23 log(const Dual23& x) { return x.chain(std::log(x.v), 1 / x.v, -1 / (x.v * x.v)); }
/// At 0, where the root has no derivative, the derivative is 0: laws are even in such arguments.
inline Dual23 sqrt(const Dual23& x) {
  const double r = std::sqrt(x.v);
  return r > 0 ? x.chain(r, 0.5 / r, -0.25 / (r * x.v)) : Dual23();
}
inline Dual23 pow(const Dual23& x, double p) {
  const double f = std::pow(x.v, p);
  return x.chain(f, p * f / x.v, p * (p - 1) * f / (x.v * x.v));
}
inline Dual23 sin(const Dual23& x) { return x.chain(std::sin(x.v), std::cos(x.v), -std::sin(x.v)); }
inline Dual23 cos(const Dual23& x) {
  return x.chain(std::cos(x.v), -std::sin(x.v), -std::cos(x.v));
}
inline Dual23 tanh(const Dual23& x) {
  const double t = std::tanh(x.v), s = 1 - t * t;
  return x.chain(t, s, -2 * t * s);
}

/// Returns f(x) for a formula with known derivatives: f, f' and f'' at value_of(x).
inline double value_of(const Dual23& x) { return x.v; }
inline Dual23 chained(const Dual23& x, double f, double f1, double f2) {
  return x.chain(f, f1, f2);
}

}  // namespace tack
