// St. Venant-Kirchhoff elasticity in the logarithmic (Hencky) strain e = ln s:
// psi = mu |e|^2 + lambda/2 (tr e)^2.
#include "energies/solid/isotropic_solid.hpp"

#include <limits>

#include <Eigen/LU>

namespace tack {

struct StvkHencky {
  Lame lame;

  double energy(const Mat3& f) const {
    if (!(f.determinant() > 0)) return std::numeric_limits<double>::infinity();
    const Vec3 e = svd3(f).s.array().log();
    return lame.mu * e.squaredNorm() + lame.lambda / 2 * e.sum() * e.sum();
  }

  PrincipalDerivatives derivatives(const Vec3& s) const {
    const Vec3 e = s.array().log(), inverse = s.cwiseInverse();
    const Vec3 tau = (2 * lame.mu * e).array() + lame.lambda * e.sum();  // Kirchhoff stress
    PrincipalDerivatives d;
    d.gradient = tau.cwiseProduct(inverse);
    d.hessian = lame.lambda * inverse * inverse.transpose();
    for (int i = 0; i < 3; ++i) d.hessian(i, i) += (2 * lame.mu - tau(i)) * inverse(i) * inverse(i);
    return d;
  }

  RootSample stretch_root(double s) const {
    return {std::sqrt(2 * lame.mu) * std::log(s), std::sqrt(2 * lame.mu) / s};
  }
  RootSample volume_root(double j) const {
    return {std::sqrt(lame.lambda) * std::log(j), std::sqrt(lame.lambda) / j};
  }
};

using StvkHenckySolid = IsotropicSolid<StvkHencky>;
TACK_REGISTER(Energy, StvkHenckySolid, "stvk_hencky",
              "St. Venant-Kirchhoff solid in Hencky strain.",
              "Li, Li, Jiang 2022, Energetically Consistent Inelasticity, section 4");

}  // namespace tack
