// St. Venant-Kirchhoff membrane in plane stress: psi = mu |E|^2 + lambda/2 (tr E)^2, E = (F^T F - I) / 2,
// lambda = E nu / (1 - nu^2). Linear in Green's strain; it does not resist compression to a line.
#include "energies/shell/membrane.hpp"

namespace tack {

struct StvkMembrane {
  PlaneStress lame;

  StvkMembrane(double young, double poisson) : lame(plane_stress(young, poisson)) {}

  Pack energy(const PlaneStrain& e, const PackMat32&) const {
    return lame.mu * (e.xx * e.xx + e.yy * e.yy + 2 * e.xy * e.xy) + lame.lambda / 2 * e.trace * e.trace;
  }

  PlaneDerivatives derivatives(const PackVec2& s) const {
    PackVec2 e;
    for (int i = 0; i < 2; ++i) e(i) = (s(i) - 1) * (s(i) + 1) / 2;
    PlaneDerivatives d;
    for (int i = 0; i < 2; ++i) {
      const Pack stress = 2 * lame.mu * e(i) + lame.lambda * (e(0) + e(1));
      d.gradient(i) = s(i) * stress;
      d.hessian(i, i) = stress + (2 * lame.mu + lame.lambda) * s(i) * s(i);
    }
    d.hessian(0, 1) = d.hessian(1, 0) = lame.lambda * s(0) * s(1);
    return d;
  }
};

using StvkMembraneEnergy = Membrane<StvkMembrane>;
TACK_REGISTER(Energy, StvkMembraneEnergy, "stvk_membrane",
              "St. Venant-Kirchhoff membrane: a sheet that is linear in Green's strain, in plane stress.",
              "Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 6.4.1; Volino et al. 2009");

}  // namespace tack
