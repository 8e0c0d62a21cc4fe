// Numbers with gradient and Hessian in N variables, pack_width side by side: formulas of a scene
// (formula_program.hpp) get their derivatives from them.
#pragma once

#include <array>
#include <cmath>

#include "geometry/pack.hpp"

namespace tack {

/// T: Pack, or double for one at a time.
template <class T, int N>
struct PackJet {
  static constexpr int curvatures = N * (N + 1) / 2;
  T v = 0;
  std::array<T, N> d;           // gradient
  std::array<T, curvatures> h;  // lower triangle of the Hessian, by rows

  PackJet() : PackJet(0.0) {}
  explicit PackJet(double value) : v(value) {
    d.fill(0);
    h.fill(0);
  }
  static PackJet variable(const T& value, int i) {
    PackJet x(0.0);
    x.v = value;
    x.d[i] = 1;
    return x;
  }

  /// Returns f(*this), given f, f' and f'' at v.
  PackJet chain(const T& f, const T& f1, const T& f2) const {
    PackJet y;
    y.v = f;
    for (int i = 0, k = 0; i < N; ++i) {
      y.d[i] = f1 * d[i];
      for (int j = 0; j <= i; ++j, ++k) y.h[k] = f2 * d[i] * d[j] + f1 * h[k];
    }
    return y;
  }

  friend PackJet operator+(PackJet a, const PackJet& b) {
    a.v += b.v;
    for (int i = 0; i < N; ++i) a.d[i] += b.d[i];
    for (int k = 0; k < curvatures; ++k) a.h[k] += b.h[k];
    return a;
  }
  friend PackJet operator-(PackJet a, const PackJet& b) {
    a.v -= b.v;
    for (int i = 0; i < N; ++i) a.d[i] -= b.d[i];
    for (int k = 0; k < curvatures; ++k) a.h[k] -= b.h[k];
    return a;
  }
  friend PackJet operator*(const PackJet& a, const PackJet& b) {
    PackJet y;
    y.v = a.v * b.v;
    for (int i = 0, k = 0; i < N; ++i) {
      y.d[i] = a.d[i] * b.v + a.v * b.d[i];
      for (int j = 0; j <= i; ++j, ++k)
        y.h[k] = a.h[k] * b.v + a.d[i] * b.d[j] + a.d[j] * b.d[i] + a.v * b.h[k];
    }
    return y;
  }
  friend PackJet operator/(const PackJet& a, const PackJet& b) {
    const T r = 1 / b.v;
    return a * b.chain(r, -r * r, 2 * r * r * r);
  }

  friend PackJet exp(const PackJet& a) {
    const T e = each(a.v, [](double x) { return std::exp(x); });
    return a.chain(e, e, e);
  }
  friend PackJet log(const PackJet& a) {
    const T r = 1 / a.v;
    return a.chain(each(a.v, [](double x) { return std::log(x); }), r, -r * r);
  }
  friend PackJet sqrt(const PackJet& a) {
    const T root = each(a.v, [](double x) { return std::sqrt(x); }), r = 1 / a.v;
    return a.chain(root, 0.5 * root * r, -0.25 * root * r * r);
  }
  friend PackJet power(const PackJet& a, double n) {
    if (n == 2) return a * a;
    // Powers of zero and of negative numbers have derivatives where the exponents allow them.
    const auto of = [&](double m) { return each(a.v, [m](double x) { return std::pow(x, m); }); };
    return a.chain(of(n), n == 0 ? T(0.0) : n * of(n - 1),
                   n == 0 || n == 1 ? T(0.0) : n * (n - 1) * of(n - 2));
  }
  friend PackJet sin(const PackJet& a) {
    const T s = each(a.v, [](double x) { return std::sin(x); });
    return a.chain(s, each(a.v, [](double x) { return std::cos(x); }), -s);
  }
  friend PackJet cos(const PackJet& a) {
    const T c = each(a.v, [](double x) { return std::cos(x); });
    return a.chain(c, each(a.v, [](double x) { return -std::sin(x); }), -c);
  }
  friend PackJet tanh(const PackJet& a) {
    const T t = each(a.v, [](double x) { return std::tanh(x); }), slope = 1 - t * t;
    return a.chain(t, slope, -2 * t * slope);
  }
  friend PackJet abs(const PackJet& a) { return chosen(a, PackJet(0.0) - a, PackJet(0.0) < a); }
  friend PackJet min(const PackJet& a, const PackJet& b) { return chosen(a, b, a < b); }
  friend PackJet max(const PackJet& a, const PackJet& b) { return chosen(a, b, b < a); }

 private:
  friend auto operator<(const PackJet& a, const PackJet& b) { return a.v < b.v; }
  template <class Mask>
  static PackJet chosen(const PackJet& yes, const PackJet& no, const Mask& mask) {
    PackJet y;
    y.v = select(mask, yes.v, no.v);
    for (int i = 0; i < N; ++i) y.d[i] = select(mask, yes.d[i], no.d[i]);
    for (int k = 0; k < curvatures; ++k) y.h[k] = select(mask, yes.h[k], no.h[k]);
    return y;
  }
  template <class F>
  static T each(const T& a, const F& f) {
    if constexpr (std::is_same_v<T, double>) {
      return f(a);
    } else {
      T out;
      for (int l = 0; l < pack_width; ++l) out.set(l, f(a[l]));
      return out;
    }
  }
};

}  // namespace tack
