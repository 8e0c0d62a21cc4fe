// Yeoh solid: W = c10 x + c20 x^2 + c30 x^3 in x = I1 - 3, shear modulus 2 c10.
#include "energies/hyperelastic/hyperelastic_membrane.hpp"
#include "energies/hyperelastic/hyperelastic_solid.hpp"

namespace tack {

struct Yeoh {
  double c10 = 1e5, c20 = 0, c30 = 0;  // Pa

  void fields(Fields& f) {
    f.number("c10", c10, units::pressure, "energy per I1 - 3").required().positive();
    f.number("c20", c20, units::pressure, "energy per (I1 - 3)^2: negative for rubber that softens at first");
    f.number("c30", c30, units::pressure, "energy per (I1 - 3)^3: stiffening at large stretches").nonnegative();
    f.check("c20", [this] {
      return c20 >= 0 || c30 > 0 ? "" : "the energy would fall without bound at large stretches; a negative c20 needs a positive c30";
    });
  }
  double shear() const { return 2 * c10; }
  Pack energy(const PackVec3& e) const {
    const Pack x = PowerSum(2, e).value();
    return x * (c10 + x * (c20 + x * c30));
  }
  IsochoricDerivatives derivatives(const PackVec3& e) const {
    const PowerSum sum(2, e);
    const Pack x = sum.value();
    IsochoricDerivatives d;
    sum.add_to(d, c10 + x * (2 * c20 + 3 * c30 * x), 2 * c20 + 6 * c30 * x);
    return d;
  }
};

using YeohSolid = HyperelasticSolid<Yeoh>;
TACK_REGISTER(Energy, YeohSolid, "yeoh", "Yeoh solid: a cubic in I1 - 3, for filled rubber.",
              "Yeoh 1993, Some forms of the strain energy function for rubber");

using YeohMembrane = HyperelasticMembrane<Yeoh>;
TACK_REGISTER(Energy, YeohMembrane, "yeoh_membrane", "Yeoh membrane: an incompressible sheet of filled rubber, a cubic in I1 - 3.",
              "Yeoh 1993, Some forms of the strain energy function for rubber");

}  // namespace tack
