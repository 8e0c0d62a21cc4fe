// Gent solid: W = -mu J_m / 2 ln(1 - (I1 - 3) / J_m), infinite from I1 - 3 = J_m on, where the
// chains of rubber are fully extended.
#include "energies/hyperelastic/hyperelastic_membrane.hpp"
#include "energies/hyperelastic/hyperelastic_solid.hpp"

namespace tack {

struct Gent {
  double modulus = 2e5;  // mu [Pa]
  double limit = 100;    // J_m

  void fields(Fields& f) {
    f.number("shear_modulus", modulus, units::pressure, "mu: shear modulus of small strains").required().positive();
    f.number("j_m", limit, units::none, "J_m: I1 - 3 at which the material locks").required().positive();
  }
  double shear() const { return modulus; }
  Pack energy(const PackVec3& e) const {
    const Pack used = PowerSum(2, e).value() / limit;
    const PackMask inside = used < 1;
    return select(inside, -modulus * limit / 2 * log1p(-select(inside, used, 0)), infinity);
  }
  IsochoricDerivatives derivatives(const PackVec3& e) const {
    const PowerSum sum(2, e);
    const Pack left = 1 - sum.value() / limit, slope = modulus / 2 / left;
    IsochoricDerivatives d;
    sum.add_to(d, slope, slope / (limit * left));
    return d;
  }

  static constexpr LimitNames limit_names{"I1 - 3 of", "j_m"};
  LimitUse limit_use(const Vec3& e) const { return {(2 * e).array().exp().sum() - 3, limit}; }
};

using GentSolid = HyperelasticSolid<Gent>;
TACK_REGISTER(Energy, GentSolid, "gent", "Gent solid: rubber with limited extensibility.",
              "Gent 1996, A new constitutive relation for rubber");

using GentMembrane = HyperelasticMembrane<Gent>;
TACK_REGISTER(Energy, GentMembrane, "gent_membrane", "Gent membrane: an incompressible rubber sheet with limited extensibility.",
              "Gent 1996, A new constitutive relation for rubber");

}  // namespace tack
