// Compressible neo-Hookean solid: psi = mu/2 (|F|^2 - 3) - mu ln J + lambda/2 (ln J)^2. It resists
// inversion: psi grows without bound as J goes to 0.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "energies/solid/isotropic_solid.hpp"

namespace tack {

struct NeoHookean {
  Lame lame;

  // In H = F - I, with J - 1 = tr H + minors + det H: near the rest shape the terms of first order
  // cancel on paper, not in floating point.
  Pack energy(const PackMat3& f) const {
    PackMat3 h = f;
    for (int i = 0; i < 3; ++i) h(i, i) -= 1;
    const Pack minors = h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0) + h(1, 1) * h(2, 2) -
                        h(1, 2) * h(2, 1) + h(2, 2) * h(0, 0) - h(2, 0) * h(0, 2);
    const Pack higher = minors + h.determinant(), growth = h.trace() + higher;
    Pack j = 1 + growth, log_j = log1p(growth);
    if (const PackMask small = growth < -0.5; any(small)) {
      j = select(small, f.determinant(), j);
      log_j = select(small, log(j), log_j);
    }
    const Pack psi = lame.mu * (h.squaredNorm() / 2 - higher + (growth - log_j)) +
                     lame.lambda / 2 * log_j * log_j;
    return select(j > 0, psi, infinity);
  }

  PrincipalDerivatives derivatives(const PackVec3& s) const {
    const Pack pressure = lame.lambda * log(s.prod()) - lame.mu;
    PrincipalDerivatives d;
    PackVec3 inverse;
    for (int i = 0; i < 3; ++i) {
      inverse(i) = 1 / s(i);
      d.gradient(i) = lame.mu * s(i) + pressure * inverse(i);
    }
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) d.hessian(i, k) = lame.lambda * inverse(i) * inverse(k);
      d.hessian(i, i) += lame.mu - pressure * inverse(i) * inverse(i);
    }
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

  // A negative lambda stays with the shape: alone it would be no sum of squares.
  auto split() const {
    const NeoHookean shape{{lame.mu, std::min(lame.lambda, 0.0)}};
    return MaterialSplit<NeoHookean, NeoHookean, LogVolume>{
        shape, shape, {std::max(lame.lambda, 0.0)}};
  }
};

}  // namespace tack
