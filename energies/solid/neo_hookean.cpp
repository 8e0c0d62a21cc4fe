// Compressible neo-Hookean solid: psi = mu/2 (|F|^2 - 3) - mu ln J + lambda/2 (ln J)^2. It resists
// inversion: psi grows without bound as J goes to 0.
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "energies/solid/isotropic_solid.hpp"

namespace tack {

struct NeoHookean {
  Lame lame;

  // In H = F - I, with J - 1 = tr H + minors + det H: near the rest shape the terms of first order
  // cancel on paper, not in floating point.
  double energy(const Mat3& f) const {
    const Mat3 h = f - Mat3::Identity();
    const double minors = h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0) + h(1, 1) * h(2, 2) -
                          h(1, 2) * h(2, 1) + h(2, 2) * h(0, 0) - h(2, 0) * h(0, 2);
    const double higher = minors + h.determinant(), growth = h.trace() + higher;
    const double j = growth > -0.5 ? 1 + growth : f.determinant();
    if (!(j > 0)) return std::numeric_limits<double>::infinity();
    const double log_j = growth > -0.5 ? std::log1p(growth) : std::log(j);
    return lame.mu * (h.squaredNorm() / 2 - higher + (growth - log_j)) + lame.lambda / 2 * log_j * log_j;
  }

  PrincipalDerivatives derivatives(const Vec3& s) const {
    const double log_j = std::log(s.prod());
    const double pressure = lame.lambda * log_j - lame.mu;
    const Vec3 inverse = s.cwiseInverse();
    PrincipalDerivatives d;
    d.gradient = lame.mu * s + pressure * inverse;
    d.hessian = lame.lambda * inverse * inverse.transpose();
    for (int i = 0; i < 3; ++i) d.hessian(i, i) += lame.mu - pressure * inverse(i) * inverse(i);
    return d;
  }

  // psi = 1/2 sum g(s_i)^2 + lambda/2 (ln J)^2, g^2 = mu (s^2 - 1 - 2 ln s) = mu (s - 1)^2 q(s).
  RootSample stretch_root(double s) const {
    const double e = s - 1;
    double q;
    if (std::abs(e) < 0.05) {  // 1 + 2 sum_(k >= 2) (-e)^(k-2) / k
      q = 0;
      for (int k = 14; k >= 2; --k) q = 2.0 / k - e * q;
      q += 1;
    } else {
      q = (e * (s + 1) - 2 * std::log(s)) / (e * e);
    }
    const double root = std::sqrt(lame.mu * q);
    return {root * e, lame.mu * (s + 1) / (s * root)};
  }
  RootSample volume_root(double j) const {
    return {std::sqrt(lame.lambda) * std::log(j), std::sqrt(lame.lambda) / j};
  }
};

using NeoHookeanSolid = IsotropicSolid<NeoHookean>;
TACK_REGISTER(Energy, NeoHookeanSolid, "neo_hookean", "Neo-Hookean solid that cannot invert.",
              "Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 6.4.3");

}  // namespace tack
