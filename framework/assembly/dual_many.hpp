// Forward-mode number in N variables: value and gradient, and with Curvature the lower triangle of
// the Hessian by rows. A formula of several vertices written as a template on its number type gets
// exact derivatives from it (formula_term.hpp).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace tack {

/// A value with its gradient and, with Curvature, its Hessian in N variables.
template <int N, bool Curvature>
struct DualMany {
  static constexpr int curvatures = Curvature ? N * (N + 1) / 2 : 0;
  double v = 0;
  std::array<double, N> d{};
  std::array<double, curvatures> h{};

  DualMany() = default;
  DualMany(double value) : v(value) {}  // NOLINT: a constant
  static DualMany variable(double value, int i) {
    DualMany x(value);
    x.d[i] = 1;
    return x;
  }

  /// Returns f(*this), given f, f' and f'' at v.
  DualMany chain(double f, double f1, double f2) const {
    DualMany y(f);
    for (int i = 0; i < N; ++i) y.d[i] = f1 * d[i];
    if constexpr (Curvature)
      for (int i = 0, k = 0; i < N; ++i)
        for (int j = 0; j <= i; ++j, ++k) y.h[k] = f2 * d[i] * d[j] + f1 * h[k];
    return y;
  }

  DualMany& operator+=(const DualMany& b) {
    v += b.v;
    for (int i = 0; i < N; ++i) d[i] += b.d[i];
    for (int k = 0; k < curvatures; ++k) h[k] += b.h[k];
    return *this;
  }
  DualMany& operator-=(const DualMany& b) {
    v -= b.v;
    for (int i = 0; i < N; ++i) d[i] -= b.d[i];
    for (int k = 0; k < curvatures; ++k) h[k] -= b.h[k];
    return *this;
  }
  DualMany& operator*=(double b) {
    v *= b;
    for (double& x : d) x *= b;
    for (double& x : h) x *= b;
    return *this;
  }
  DualMany& operator*=(const DualMany& b) { return *this = *this * b; }
  DualMany& operator/=(const DualMany& b) { return *this = *this / b; }

  friend DualMany operator+(DualMany a, const DualMany& b) { return a += b; }
  friend DualMany operator-(DualMany a, const DualMany& b) { return a -= b; }
  friend DualMany operator-(DualMany a) { return a *= -1; }
  friend DualMany operator*(DualMany a, double b) { return a *= b; }
  friend DualMany operator*(double a, DualMany b) { return b *= a; }
  friend DualMany operator/(DualMany a, double b) { return a *= 1 / b; }
  friend DualMany operator+(DualMany a, double b) { return a.v += b, a; }
  friend DualMany operator+(double a, DualMany b) { return b.v += a, b; }
  friend DualMany operator-(DualMany a, double b) { return a.v -= b, a; }
  friend DualMany operator-(double a, DualMany b) { return b *= -1, b.v += a, b; }
  friend DualMany operator*(const DualMany& a, const DualMany& b) {
    DualMany y(a.v * b.v);
    for (int i = 0; i < N; ++i) y.d[i] = a.d[i] * b.v + a.v * b.d[i];
    if constexpr (Curvature)
      for (int i = 0, k = 0; i < N; ++i)
        for (int j = 0; j <= i; ++j, ++k)
          y.h[k] = a.h[k] * b.v + a.d[i] * b.d[j] + a.d[j] * b.d[i] + a.v * b.h[k];
    return y;
  }
  friend DualMany reciprocal(const DualMany& a) {
    const double r = 1 / a.v;
    return a.chain(r, -r * r, 2 * r * r * r);
  }
  friend DualMany operator/(const DualMany& a, const DualMany& b) { return a * reciprocal(b); }
  friend DualMany operator/(double a, const DualMany& b) { return a * reciprocal(b); }
  friend bool operator<(const DualMany& a, const DualMany& b) { return a.v < b.v; }
  friend bool operator>(const DualMany& a, const DualMany& b) { return a.v > b.v; }
  friend bool operator<=(const DualMany& a, const DualMany& b) { return a.v <= b.v; }
  friend bool operator>=(const DualMany& a, const DualMany& b) { return a.v >= b.v; }
  friend bool operator==(const DualMany& a, const DualMany& b) { return a.v == b.v; }
  friend bool operator!=(const DualMany& a, const DualMany& b) { return a.v != b.v; }

  friend DualMany abs(const DualMany& a) { return a.v < 0 ? -a : a; }
  // At 0, where the root has no derivative, the derivative is 0: formulas are even in such
  // arguments.
  friend DualMany sqrt(const DualMany& a) {
    const double r = std::sqrt(a.v);
    return r > 0 ? a.chain(r, 0.5 / r, -0.25 / (r * a.v)) : DualMany();
  }
  friend DualMany log(const DualMany& a) {
    return a.chain(std::log(a.v), 1 / a.v, -1 / (a.v * a.v));
  }
  friend DualMany exp(const DualMany& a) {
    const double e = std::exp(a.v);
    return a.chain(e, e, e);
  }
  friend DualMany pow(const DualMany& a, double p) {
    const double f = std::pow(a.v, p);
    return a.chain(f, p * f / a.v, p * (p - 1) * f / (a.v * a.v));
  }
  friend DualMany sin(const DualMany& a) {
    return a.chain(std::sin(a.v), std::cos(a.v), -std::sin(a.v));
  }
  friend DualMany cos(const DualMany& a) {
    return a.chain(std::cos(a.v), -std::sin(a.v), -std::cos(a.v));
  }
  friend DualMany tanh(const DualMany& a) {
    const double t = std::tanh(a.v), s = 1 - t * t;
    return a.chain(t, s, -2 * t * s);
  }
  friend DualMany acos(const DualMany& a) {
    const double s = std::sqrt(1 - a.v * a.v);
    return a.chain(std::acos(a.v), -1 / s, -a.v / (s * s * s));
  }
  // Returns the angle of (x, y), from the smaller one of the quotients y/x and x/y.
  friend DualMany atan2(const DualMany& y, const DualMany& x) {
    const bool steep = std::abs(y.v) > std::abs(x.v);
    const DualMany q = steep ? x / y : y / x;
    const double s = 1 / (1 + q.v * q.v);
    DualMany angle = q.chain(std::atan(q.v), s, -2 * q.v * s * s);
    if (steep) angle = -angle;
    angle.v = std::atan2(y.v, x.v);
    return angle;
  }
};

/// Returns the value of a number, for the branches of a formula.
template <int N, bool Curvature>
double value_of(const DualMany<N, Curvature>& x) {
  return x.v;
}
/// Returns f(x) for a formula with known derivatives: f, f' and f'' at value_of(x).
template <int N, bool Curvature>
DualMany<N, Curvature> chained(const DualMany<N, Curvature>& x, double f, double f1, double f2) {
  return x.chain(f, f1, f2);
}

}  // namespace tack

namespace Eigen {

template <int N, bool Curvature>
struct NumTraits<tack::DualMany<N, Curvature>> : NumTraits<double> {
  using Real = tack::DualMany<N, Curvature>;
  using NonInteger = Real;
  using Nested = Real;
  // NOLINTBEGIN(readability-identifier-naming): the names are Eigen's
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N,
    AddCost = N,
    MulCost = N * N
  };
  // NOLINTEND(readability-identifier-naming)
};

template <int N, bool Curvature, class Operation>
struct ScalarBinaryOpTraits<tack::DualMany<N, Curvature>, double, Operation> {
  using ReturnType = tack::DualMany<N, Curvature>;
};
template <int N, bool Curvature, class Operation>
struct ScalarBinaryOpTraits<double, tack::DualMany<N, Curvature>, Operation> {
  using ReturnType = tack::DualMany<N, Curvature>;
};

}  // namespace Eigen
