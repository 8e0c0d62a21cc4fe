// Fixed corotated elasticity: psi = mu sum (s_i - 1)^2 + lambda/2 (J - 1)^2.
#include "energies/solid/isotropic_solid.hpp"

#include <Eigen/LU>

namespace tack {

struct FixedCorotated {
  Lame lame;

  Pack energy(const PackMat3& f) const {
    const Pack growth = f.determinant() - 1;
    const PackVec3 s = svd3(f).s;
    Pack squares = 0;
    for (int i = 0; i < 3; ++i) squares += (s(i) - 1) * (s(i) - 1);
    return select(growth > -1, lame.mu * squares + lame.lambda / 2 * growth * growth, infinity);
  }

  PrincipalDerivatives derivatives(const PackVec3& s) const {
    const Pack pressure = lame.lambda * (s.prod() - 1);
    const PackVec3 cofactor(s(1) * s(2), s(0) * s(2), s(0) * s(1));
    PrincipalDerivatives d;
    for (int i = 0; i < 3; ++i) {
      d.gradient(i) = 2 * lame.mu * (s(i) - 1) + pressure * cofactor(i);
      for (int k = 0; k < 3; ++k) {
        d.hessian(i, k) = lame.lambda * cofactor(i) * cofactor(k);
        d.hessian(i, k) += k == i ? Pack(2 * lame.mu) : pressure * s(3 - i - k);
      }
    }
    return d;
  }

  RootSample stretch_root(double s) const { return {std::sqrt(2 * lame.mu) * (s - 1), std::sqrt(2 * lame.mu)}; }
  RootSample volume_root(double j) const { return {std::sqrt(lame.lambda) * (j - 1), std::sqrt(lame.lambda)}; }
};

using FixedCorotatedSolid = IsotropicSolid<FixedCorotated>;
TACK_REGISTER(Energy, FixedCorotatedSolid, "fixed_corotated", "Fixed corotated solid.",
              "Stomakhin et al. 2012, Energetically Consistent Invertible Elasticity");

}  // namespace tack
