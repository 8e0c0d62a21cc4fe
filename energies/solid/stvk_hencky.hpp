// St. Venant-Kirchhoff elasticity in the logarithmic (Hencky) strain e = ln s:
// psi = mu |e|^2 + lambda/2 (tr e)^2.
#pragma once

#include <Eigen/LU>
#include <algorithm>

#include "energies/solid/isotropic_solid.hpp"

namespace tack {

struct StvkHencky {
  Lame lame;

  Pack energy(const PackMat3& f) const {
    const PackVec3 s = svd3(f).s;
    const PackVec3 e(log(s(0)), log(s(1)), log(s(2)));
    const Pack trace = e.sum();
    return select(f.determinant() > 0, lame.mu * e.squaredNorm() + lame.lambda / 2 * trace * trace,
                  infinity);
  }

  PrincipalDerivatives derivatives(const PackVec3& s) const {
    const PackVec3 e(log(s(0)), log(s(1)), log(s(2)));
    const Pack pressure = lame.lambda * e.sum();
    PackVec3 tau;
    for (int i = 0; i < 3; ++i) tau(i) = 2 * lame.mu * e(i) + pressure;
    return of_logarithms(s, tau, PackMat3::Constant(lame.lambda), 2 * lame.mu);
  }

  RootSample stretch_root(double s) const {
    return {std::sqrt(2 * lame.mu) * std::log(s), std::sqrt(2 * lame.mu) / s};
  }
  RootSample volume_root(double j) const {
    return {std::sqrt(lame.lambda) * std::log(j), std::sqrt(lame.lambda) / j};
  }

  // A negative lambda stays with the shape: alone it would be no sum of squares.
  auto split() const {
    const StvkHencky shape{{lame.mu, std::min(lame.lambda, 0.0)}};
    return MaterialSplit<StvkHencky, StvkHencky, LogVolume>{
        shape, shape, {std::max(lame.lambda, 0.0)}};
  }
};

}  // namespace tack
