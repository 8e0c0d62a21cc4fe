// Derivatives in logarithmic isochoric stretches e_i = ln s_i - (ln J)/3, whose sum is zero. With
// sums of powers of the isochoric stretches,
//     S_a(e) = sum over i of exp(a e_i) - 3,
// the invariants are I1 - 3 = S_2 and I2 - 3 = S_-2, and Ogden's terms are mu_p/alpha_p S_alpha_p.
#pragma once

#include <cmath>

#include "energies/solid/principal.hpp"
#include "geometry/pack.hpp"

namespace tack {

/// Returns exp(x) - 1.
inline Pack expm1(const Pack& x) {
  Pack out;
  for (int l = 0; l < pack_width; ++l) out.set(l, std::expm1(x[l]));
  return out;
}

/// Returns exp(x) - 1 - x, to rounding for small x as well.
inline Pack exp_remainder(const Pack& x) {
  constexpr double series_below = 0.5;  // there, terms beyond x^15/15! are below rounding
  const PackMask small = abs(x) < series_below;
  Pack series = 1;
  for (int k = 15; k >= 3; --k) series = 1 + x / k * series;
  return select(small, x * x / 2 * series, expm1(x) - x);
}

/// Gradient and Hessian of W(e) [Pa]. Only their deviators count, so that a constant may be added
/// to all entries of the gradient.
struct IsochoricDerivatives {
  PackVec3 gradient = PackVec3::Zero();
  PackMat3 hessian = PackMat3::Zero();
};

/// S_a, with its derivatives. The gradient a (exp(a e_i) - 1) vanishes at rest.
class PowerSum {
 public:
  PowerSum(double a, const PackVec3& e) : a_(a), e_(e) {}

  /// Sum of exp(a e_i) - 1 - a e_i: terms of first order add up to zero.
  Pack value() const {
    return exp_remainder(a_ * e_(0)) + exp_remainder(a_ * e_(1)) + exp_remainder(a_ * e_(2));
  }
  /// Adds the derivatives of f(S_a). slope, curvature: f', f'' [Pa].
  void add_to(IsochoricDerivatives& d, const Pack& slope, const Pack& curvature) const {
    PackVec3 gradient;
    for (int i = 0; i < 3; ++i) gradient(i) = a_ * expm1(a_ * e_(i));
    for (int i = 0; i < 3; ++i) {
      d.gradient(i) += slope * gradient(i);
      d.hessian(i, i) += slope * a_ * (gradient(i) + a_);
    }
    // The deviator of the gradient is that of S_a whatever constant its entries have in common.
    const Pack mean = gradient.sum() / 3;
    for (int i = 0; i < 3; ++i) gradient(i) -= mean;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) d.hessian(i, k) += curvature * gradient(i) * gradient(k);
  }

 private:
  double a_;
  const PackVec3& e_;
};

}  // namespace tack
