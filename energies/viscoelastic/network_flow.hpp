// Viscous flow of a nonequilibrium network (bergstrom_boyce.hpp) over an implicit step. With
// n = |dev e|, e the elastic Hencky strain, and the network's springs mu n^2, n flows at the rate
//     dn/dt = -r c (n / n_0)^m ,
// c the factor of the step (chain_factor, temperature). Backward Euler from the trial norm n:
//     n_e + n_0 k (n_e / n_0)^m = n,   k = h r c / n_0 .
// History variables of a step are fixed, so the step has the potential
//     W(n) = mu n_e^2 + 2 mu m / (m + 1) n_e (n - n_e),   W' = 2 mu n_e
// (the minimum of stored energy and h times the dissipation potential over all flows).
// Source: Ortiz and Stainier 1999, The variational formulation of viscoplastic constitutive
// updates.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/pack_exp.hpp"
#include "geometry/types.hpp"

namespace tack {

struct NetworkFlow {
  double mu;                  // shear modulus of the springs [Pa]
  double norm;                // n_0: |dev e| at the reference stress
  double rate;                // r: rate of |dev e| at n_0 [1/s]
  double exponent;            // m >= 1
  double chain_exponent = 0;  // C: the rate is multiplied by (chain - 1 + offset)^C
  double chain_offset = 0.01;

  /// Fraction of the trial norm that a step leaves, and the fraction that flows; they sum to 1.
  template <class T>
  struct Fractions {
    T left, flowed;
  };

  /// Returns ln k of a step h >= 0 [s] that starts at an inverse viscous deformation F_v^-1;
  /// slowdown: factor of all times (a_T of a temperature).
  double log_factor(double h, double slowdown, const Mat3& inverse) const {
    double log_k = std::log(h * rate / (norm * slowdown));
    if (chain_exponent != 0)
      log_k += chain_exponent * std::log(chain_stretch(inverse) - 1 + chain_offset);
    return log_k;
  }

  /// Returns the fractions of a step. trial: n. T: double, or Pack for several samples.
  template <class T>
  Fractions<T> fractions(const T& trial, const T& log_k) const {
    using std::abs, std::exp, std::log;
    if (exponent == 1) {
      const T k = exp(log_k), left = 1 / (1 + k);
      return {left, select(k < 1, k * left, 1 - left)};
    }
    // With y = n_e / n = exp(u): y + q y^m = 1, a convex function of u, by Halley's method.
    const T log_q = log_k + (exponent - 1) * log(trial / norm), q = exp(log_q);
    const auto flows = log_q > log_small;
    T u = select(log_q > 0, -log_q / exponent, 0);
    auto moves = flows;
    for (int i = 0; i < iterations_max && any(moves); ++i) {
      const T y = exp(u), power = exp(log_q + exponent * u);
      const T slope = y + exponent * power, curvature = y + exponent * exponent * power;
      const T newton = (y + power - 1) / slope, bend = newton * curvature / (2 * slope);
      const T step = newton / (1 - select(bend < 0.5, bend, 0.5));
      u = select(moves, u - step, u);
      moves = moves & (abs(exponent * step) > last_step);
    }
    const T y = exp(u), power = exp(log_q + exponent * u);
    return {select(flows, y, 1 - q), select(flows, select(y < 0.5, 1 - y, power), q)};
  }

  /// Returns W / (mu n^2).
  template <class T>
  T potential(const Fractions<T>& f) const {
    return f.left * (f.left + 2 * exponent / (exponent + 1) * f.flowed);
  }
  /// Returns dn_e / dn.
  template <class T>
  T tangent(const Fractions<T>& f) const {
    return f.left / (f.left + exponent * f.flowed);
  }

 private:
  static constexpr double log_small = -20;    // m q^2 is round-off beside 1
  static constexpr int iterations_max = 100;  // about 3 are usual
  // Convergence is of third order: the error after a step s is a fraction of m^2 s^3.
  static constexpr double last_step = 2e-5;

  // Returns the stretch of a chain, the root mean square of the principal stretches of F_v. Of
  // det F = 1 the inverse is the transposed cofactor matrix.
  static double chain_stretch(const Mat3& inverse) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += inverse.col(i).cross(inverse.col((i + 1) % 3)).squaredNorm();
    return std::max(1.0, std::sqrt(sum / 3));
  }
};

}  // namespace tack
