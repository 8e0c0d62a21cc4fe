// Isotropic material whose density is a formula of the scene (energy_formula.hpp), with or without
// a separate formula U(J) of the volume, psi = W + U.
#pragma once

#include <algorithm>

#include "energies/hyperelastic/energy_formula.hpp"
#include "energies/solid/composite_term.hpp"
#include "energies/solid/patch_term.hpp"
#include "energies/solid/isotropic_solid.hpp"

namespace tack {

/// factor * U(J) of a formula in J.
struct ExpressionVolume {
  EnergyFormula formula;
  double factor = 1;

  /// growth: J - 1.
  template <class T>
  VolumeSample<T> at(const T& growth) const {
    using Jet = PackJet<T, 1>;
    // A stretch along one axis has J for its stretch.
    const Jet u = formula(std::array<Jet, 3>{Jet::variable(T(1 + growth), 0), Jet(1.0), Jet(1.0)});
    return {factor * u.v, factor * u.d[0], factor * u.h[0]};
  }
};

/// W + factor * U at a point.
struct ExpressionMaterial {
  EnergyFormula energy_formula, volume_formula;
  double factor = 1;       // of U
  Lame lame = {};          // of small strains, W and U [Pa]
  double volume_bulk = 0;  // bulk modulus of U at small strains [Pa]

  Pack energy(const PackMat3& f) const {
    const PackVec3 s = svd3(f).s;
    using Jet = PackJet<Pack, 1>;
    Jet at[3];
    for (int i = 0; i < 3; ++i) at[i].v = s(i);
    const Pack psi = sum(std::array<Jet, 3>{at[0], at[1], at[2]}).v;
    return select((f.determinant() > 0) & (psi < infinity), psi, infinity);
  }
  PrincipalDerivatives derivatives(const PackVec3& s) const {
    using Jet = PackJet<Pack, 3>;
    const Jet psi = sum(
        std::array<Jet, 3>{Jet::variable(s(0), 0), Jet::variable(s(1), 1), Jet::variable(s(2), 2)});
    PrincipalDerivatives d;
    for (int i = 0, k = 0; i < 3; ++i) {
      d.gradient(i) = psi.d[i];
      for (int j = 0; j <= i; ++j, ++k) d.hessian(i, j) = d.hessian(j, i) = psi.h[k];
    }
    return d;
  }

  // Points and parts keep what they need of U for the bulk modulus of a solid with lambda = 0, as
  // other elastic solids do.
  auto split() const {
    const double own = lame.lambda + 2 * lame.mu / 3 - volume_bulk, wanted = 2 * lame.mu / 3;
    const double kept = volume_bulk > 0 ? std::clamp((wanted - own) / volume_bulk, 0.0, 1.0) : 1;
    ExpressionMaterial shape = *this;
    shape.factor = kept;
    return MaterialSplit<ExpressionMaterial, ExpressionMaterial, ExpressionVolume>{
        shape, shape, {volume_formula, 1 - kept}};
  }

 private:
  template <class Jet>
  Jet sum(const std::array<Jet, 3>& s) const {
    return energy_formula(s) + Jet(factor) * volume_formula(s);
  }
};

}  // namespace tack
