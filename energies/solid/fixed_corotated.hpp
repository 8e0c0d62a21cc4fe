// Fixed corotated elasticity: psi = mu sum (s_i - 1)^2 + lambda/2 (J - 1)^2. It is finite at J = 0
// and would allow tets to collapse. A barrier acts below a tenth of the rest volume:
//     psi += (lambda + 2 mu) J0 b(J / J0),   b(r) = -(1 - r)^2 ln r,   r < 1,   J0 = 0.1.
#pragma once

#include <Eigen/LU>
#include <algorithm>

#include "energies/solid/neo_hookean.hpp"

namespace tack {

struct FixedCorotated {
  // J0: part of the volume below which the barrier acts
  static constexpr double smallest_free = 0.1;

  Lame lame;

  double barrier() const { return (lame.lambda + 2 * lame.mu) * smallest_free; }

  Pack energy(const PackMat3& f) const {
    const Pack growth = f.determinant() - 1;
    const PackVec3 s = svd3(f).s;
    Pack squares = 0;
    for (int i = 0; i < 3; ++i) squares += (s(i) - 1) * (s(i) - 1);
    Pack psi = lame.mu * squares + lame.lambda / 2 * growth * growth;
    const Pack r = (1 + growth) / smallest_free;
    if (const PackMask crushed = r < 1; any(crushed))
      psi = select(crushed, psi - barrier() * (1 - r) * (1 - r) * log(r), psi);
    return select(growth > -1, psi, infinity);
  }

  PrincipalDerivatives derivatives(const PackVec3& s) const {
    Pack pressure = lame.lambda * (s.prod() - 1), bulk = lame.lambda;
    const Pack r = s.prod() / smallest_free;
    if (const PackMask crushed = r < 1; any(crushed)) {
      const Pack rest = 1 - r, log_r = log(r), first = 2 * rest * log_r - rest * rest / r;
      const Pack second = rest * (4 / r + rest / (r * r)) - 2 * log_r;
      pressure = select(crushed, pressure + barrier() / smallest_free * first, pressure);
      bulk = select(crushed, bulk + barrier() / (smallest_free * smallest_free) * second, bulk);
    }
    const PackVec3 cofactor(s(1) * s(2), s(0) * s(2), s(0) * s(1));
    PrincipalDerivatives d;
    for (int i = 0; i < 3; ++i) {
      d.gradient(i) = 2 * lame.mu * (s(i) - 1) + pressure * cofactor(i);
      for (int k = 0; k < 3; ++k) {
        d.hessian(i, k) = bulk * cofactor(i) * cofactor(k);
        d.hessian(i, k) += k == i ? Pack(2 * lame.mu) : pressure * s(3 - i - k);
      }
    }
    return d;
  }

  RootSample stretch_root(double s) const {
    return {std::sqrt(2 * lame.mu) * (s - 1), std::sqrt(2 * lame.mu)};
  }
  RootSample volume_root(double j) const {
    if (j >= smallest_free) return {std::sqrt(lame.lambda) * (j - 1), std::sqrt(lame.lambda)};
    const double r = j / smallest_free, rest = 1 - r, log_r = std::log(r);
    const double root =
        -std::sqrt(lame.lambda * (j - 1) * (j - 1) - 2 * barrier() * rest * rest * log_r);
    return {root, (lame.lambda * (j - 1) +
                   barrier() / smallest_free * (2 * rest * log_r - rest * rest / r)) /
                      root};
  }

  // The barrier stays with psi_s at every point. Parts of tets, which have little weight, are
  // neo-Hookean, so that they resist inversion.
  auto split() const {
    const double negative = std::min(lame.lambda, 0.0);
    return MaterialSplit<FixedCorotated, NeoHookean, QuadraticVolume>{
        {{lame.mu, negative}}, {{lame.mu, negative}}, {lame.lambda - negative}};
  }
};

}  // namespace tack
