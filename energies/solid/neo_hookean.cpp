// Compressible neo-Hookean solid: psi = mu/2 (|F|^2 - 3) - mu ln J + lambda/2 (ln J)^2. It resists
// inversion: psi grows without bound as J goes to 0.
#include <limits>

#include <Eigen/LU>

#include "energies/solid/isotropic_solid.hpp"

namespace tack {

struct NeoHookean {
  Lame lame;

  double energy(const Mat3& f) const {
    const double j = f.determinant();
    if (!(j > 0)) return std::numeric_limits<double>::infinity();
    const double log_j = std::log(j);
    return lame.mu / 2 * (f.squaredNorm() - 3) - lame.mu * log_j + lame.lambda / 2 * log_j * log_j;
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
};

using NeoHookeanSolid = IsotropicSolid<NeoHookean>;
TACK_REGISTER(Energy, NeoHookeanSolid, "neo_hookean", "Neo-Hookean solid that cannot invert.",
              "Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 6.4.3");

}  // namespace tack
