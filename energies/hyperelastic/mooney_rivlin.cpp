// Mooney-Rivlin solid: W = c10 (I1 - 3) + c01 (I2 - 3), shear modulus 2 (c10 + c01).
#include "energies/hyperelastic/hyperelastic_membrane.hpp"
#include "energies/hyperelastic/hyperelastic_solid.hpp"

namespace tack {

struct MooneyRivlin {
  double c10 = 1e5, c01 = 0;  // Pa

  void fields(Fields& f) {
    f.number("c10", c10, units::pressure, "energy per I1 - 3").required().nonnegative();
    f.number("c01", c01, units::pressure, "energy per I2 - 3").nonnegative();
    f.check("c10", [this] {
      return c10 + c01 > 0 ? "" : "the shear modulus 2 (c10 + c01) is zero; make one of both positive";
    });
  }
  double shear() const { return 2 * (c10 + c01); }
  Pack energy(const PackVec3& e) const {
    return c10 * PowerSum(2, e).value() + c01 * PowerSum(-2, e).value();
  }
  IsochoricDerivatives derivatives(const PackVec3& e) const {
    IsochoricDerivatives d;
    PowerSum(2, e).add_to(d, c10, 0);
    PowerSum(-2, e).add_to(d, c01, 0);
    return d;
  }
};

using MooneyRivlinSolid = HyperelasticSolid<MooneyRivlin>;
TACK_REGISTER(Energy, MooneyRivlinSolid, "mooney_rivlin",
              "Mooney-Rivlin solid: rubber up to moderate stretches.",
              "Mooney 1940; Rivlin 1948, Large elastic deformations of isotropic materials IV");

using MooneyRivlinMembrane = HyperelasticMembrane<MooneyRivlin>;
TACK_REGISTER(Energy, MooneyRivlinMembrane, "mooney_rivlin_membrane", "Mooney-Rivlin membrane: an incompressible rubber sheet up to moderate stretches.",
              "Mooney 1940; Rivlin 1948, Large elastic deformations of isotropic materials IV");

}  // namespace tack
