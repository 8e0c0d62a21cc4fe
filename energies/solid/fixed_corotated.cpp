// Fixed corotated elasticity: psi = mu sum (s_i - 1)^2 + lambda/2 (J - 1)^2.
#include "energies/solid/isotropic_solid.hpp"

#include <limits>

#include <Eigen/LU>

namespace tack {

struct FixedCorotated {
  Lame lame;

  double energy(const Mat3& f) const {
    const double j = f.determinant();
    if (!(j > 0)) return std::numeric_limits<double>::infinity();
    const Vec3 s = svd3(f).s;
    return lame.mu * (s.array() - 1).square().sum() + lame.lambda / 2 * (j - 1) * (j - 1);
  }

  PrincipalDerivatives derivatives(const Vec3& s) const {
    const double j = s.prod();
    const Vec3 cofactor(s(1) * s(2), s(0) * s(2), s(0) * s(1));
    PrincipalDerivatives d;
    d.gradient = 2 * lame.mu * (s.array() - 1).matrix() + lame.lambda * (j - 1) * cofactor;
    d.hessian = lame.lambda * cofactor * cofactor.transpose();
    for (int i = 0; i < 3; ++i) {
      d.hessian(i, i) += 2 * lame.mu;
      for (int k = 0; k < 3; ++k)
        if (k != i) d.hessian(i, k) += lame.lambda * (j - 1) * s(3 - i - k);
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
