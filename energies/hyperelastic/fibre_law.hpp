// Fibres of Holzapfel, Gasser and Ogden: families of dispersed fibres that resist tension alone.
// With the structure tensor H = kappa I + (1 - n kappa) d d^T of a family along d, n = 3 in solids
// and 2 in sheets, whose trace is one, its mean strain and its energy per rest volume are
//     E = tr(F H F^T) - 1 = kappa (I1 - n) + (1 - n kappa) (I4 - 1),
//     psi = k1 / (2 k2) (exp(k2 E^2) - 1) if E > 0, else 0.
// kappa = 0: all fibres along d; 1/n: isotropic. I1 and I4 are those of F, volume included: fibres
// that depended on the isochoric part alone would swell under tension (Nolan et al. 2014). psi is
// convex in F, because E is. Sources: Holzapfel, Gasser, Ogden 2000, A new constitutive framework
// for arterial wall mechanics; Gasser, Ogden, Holzapfel 2006, Hyperelastic modelling of arterial
// layers with distributed collagen fibre orientations.
#pragma once

#include <limits>

#include "energies/hyperelastic/isochoric.hpp"

namespace tack {

struct FibreLaw {
  double k1 = 1e3;  // Pa
  double k2 = 1;
  double kappa = 0;  // dispersion

  Pack energy(const Pack& e) const {
    const Pack strain = select(e > 0, e, 0);
    return k1 / (2 * k2) * expm1(k2 * strain * strain);
  }
  // psi' and psi'' by E [Pa].
  struct Slopes {
    Pack first, second;
  };
  Slopes slopes(const Pack& e) const {
    const Pack strain = select(e > 0, e, 0), growth = k1 * (expm1(k2 * strain * strain) + 1);
    return {growth * strain, select(e > 0, growth * (1 + 2 * k2 * strain * strain), 0)};
  }
};

}  // namespace tack
