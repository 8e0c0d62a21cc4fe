// Rubber membranes: incompressible sheets in plane stress, of a law W in logarithmic isochoric
// stretches (isochoric.hpp). The volume gives the stretch across the sheet, s3 = 1 / (s1 s2):
//     psi(e1, e2) = W(e1, e2, -e1 - e2),   e_i = ln s_i,
//     psi_i = W_i - W_3,   psi_ik = W_ik - W_i3 - W_3k + W_33.
// So the stress across the sheet vanishes, and Kirchhoff's stress in it is psi_i per rest volume.
// Source: Holzapfel 2000, Nonlinear Solid Mechanics, section 6.5 (biaxial deformation).
#pragma once

#include "energies/hyperelastic/hyperelastic_solid.hpp"
#include "energies/shell/membrane_term.hpp"

namespace tack {

template <class Law>
struct HyperelasticSheet {
  Law law;

  Pack energy(const PlaneStrain&, const PackMat32& f) const {
    const PackVec2 s = plane_stretch(f).s;
    return select(s.prod() > 0, law.energy(strain(s)), infinity);
  }
  PlaneDerivatives derivatives(const PackVec2& s) const {
    const IsochoricDerivatives w = law.derivatives(strain(s));
    PackVec2 tau;
    PackMat2 h;
    for (int i = 0; i < 2; ++i) {
      tau(i) = w.gradient(i) - w.gradient(2);
      for (int k = 0; k < 2; ++k)
        h(i, k) = w.hessian(i, k) - w.hessian(i, 2) - w.hessian(2, k) + w.hessian(2, 2);
    }
    return of_logarithms(s, tau, h);
  }

  static constexpr LimitNames limit_names = names_of_limit<Law>();
  LimitUse limit_use(std::span<const double> stretches) const requires LimitedLaw<Law> {
    const double e0 = std::log(stretches[0]), e1 = std::log(stretches[1]);
    return law.limit_use({e0, e1, -(e0 + e1)});
  }

 private:
  static PackVec3 strain(const PackVec2& s) {
    const Pack e0 = log(s(0)), e1 = log(s(1));
    return {e0, e1, -(e0 + e1)};
  }
};

/// Base of energies of rubber membranes. Law: as for HyperelasticSolid.
template <class Law>
class HyperelasticMembrane : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    law_.fields(f);
    f.number("density", density_, units::density, "mass per rest volume").positive();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    require_sheet(body, rest, type());
    return make_law_term<MembraneTerm<HyperelasticSheet<Law>>, Triangle, Law>(
        std::string(type()), HyperelasticSheet<Law>{law_}, body, rest);
  }
  void add_mass(const Body& body, const VecX& rest, VecX& mass) const override {
    add_sheet_mass(body, rest, density_, mass);
  }
  std::optional<double> young() const override { return 3 * law_.shear(); }
  std::optional<double> shear() const override { return law_.shear(); }

 private:
  Law law_;
  double density_ = 1000;  // kg/m^3
};

}  // namespace tack
