// Ogden solid: W = sum of mu_p / alpha_p (exp(alpha_p e_i) - 1) over terms p and directions i, the
// convention of Ogden's paper. The shear modulus is the sum of mu_p alpha_p / 2.
#include <algorithm>
#include <vector>

#include "energies/hyperelastic/hyperelastic_membrane.hpp"
#include "energies/hyperelastic/hyperelastic_solid.hpp"

namespace tack {

struct OgdenTerm {
  double modulus = 2e5;  // mu_p [Pa]
  double exponent = 2;   // alpha_p

  void fields(Fields& f) {
    f.number("modulus", modulus, units::pressure, "mu_p").required();
    f.number("exponent", exponent, units::none, "alpha_p, not zero").required();
    f.check("exponent", [this] { return exponent != 0 ? "" : "must not be zero"; });
  }
};

struct Ogden {
  std::vector<OgdenTerm> terms = {OgdenTerm()};

  void fields(Fields& f) {
    f.list("terms", terms, "terms mu_p/alpha_p (s1^alpha_p + s2^alpha_p + s3^alpha_p - 3) of the energy, s: isochoric stretches; the "
                           "shear modulus of small strains is the sum of mu_p alpha_p / 2").required().nonempty();
    f.check("terms", [this] { return error(); });
  }
  double shear() const {
    double sum = 0;
    for (const OgdenTerm& t : terms) sum += t.modulus * t.exponent / 2;
    return sum;
  }
  Pack energy(const PackVec3& e) const {
    Pack sum = 0;
    for (const OgdenTerm& t : terms)
      sum += t.modulus / t.exponent * PowerSum(t.exponent, e).value();
    return sum;
  }
  IsochoricDerivatives derivatives(const PackVec3& e) const {
    IsochoricDerivatives d;
    for (const OgdenTerm& t : terms)
      PowerSum(t.exponent, e).add_to(d, t.modulus / t.exponent, 0);
    return d;
  }

 private:
  // One of the largest and the least exponent governs each large stretch. In tension e is
  // proportional to (2, -1, -1), in equibiaxial tension to (1, 1, -2), so that an exponent is never
  // felt where the other is more than twice as large.
  std::string error() const {
    if (!(shear() > 0))
      return "the shear modulus, the sum of modulus * exponent / 2, is not positive";
    const auto by_exponent = [](const OgdenTerm& a, const OgdenTerm& b) { return a.exponent < b.exponent; };
    const auto [low, high] = std::minmax_element(terms.begin(), terms.end(), by_exponent);
    for (const OgdenTerm& t : {*low, *high}) {
      const double other = t.exponent > 0 ? std::max(0.0, -low->exponent) : std::max(0.0, high->exponent);
      const bool extreme = t.exponent > 0 ? t.exponent == high->exponent : t.exponent == low->exponent;
      if (extreme && t.modulus * t.exponent < 0 && other <= 2 * std::abs(t.exponent))
        return "the energy would fall without bound at large stretches: the term of exponent " +
               std::to_string(t.exponent) + " needs a modulus of the same sign";
    }
    return "";
  }
};

using OgdenSolid = HyperelasticSolid<Ogden>;
TACK_REGISTER(Energy, OgdenSolid, "ogden", "Ogden solid: sums of powers of the stretches, for rubber.",
              "Ogden 1972, Large deformation isotropic elasticity: on the correlation of theory and experiment for incompressible rubberlike solids");

using OgdenMembrane = HyperelasticMembrane<Ogden>;
TACK_REGISTER(Energy, OgdenMembrane, "ogden_membrane", "Ogden membrane: an incompressible rubber sheet, by sums of powers of the stretches.",
              "Ogden 1972, Large deformation isotropic elasticity: on the correlation of theory and experiment for incompressible rubberlike solids");

}  // namespace tack
