// Strain limit of a sheet: cloth and backings of tapes stretch easily up to a strain at which their
// threads or chains are straight, and hardly any further. With s_i the principal stretches, a start
// s_0 and a limit s_1,
//     psi = sum_i -k y_i^2 ln(1 - y_i),   y_i = (s_i - s_0) / (s_1 - s_0) where it is positive,
// which has two continuous derivatives at s_0 and is infinite from s_1 on: line searches accept no
// triangle beyond the limit. Compression is not limited. Source: Li, Kaufman and Jiang 2021,
// Codimensional Incremental Potential Contact, section 5 (isotropic strain limiting).
#include <fmt/format.h>

#include <limits>

#include "energies/shell/membrane_term.hpp"
#include "energies/solid/limited_term.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"

namespace tack {
namespace {

struct StrainLimit {
  double start, range;  // s_0, s_1 - s_0
  double stiffness;     // k [J/m^3]

  Pack energy(const PlaneStrain&, const PackMat32& f) const {
    const PackVec2 s = plane_stretch(f).s;
    Pack psi = 0;
    for (int i = 0; i < 2; ++i) {
      const Pack y = (s(i) - start) / range;
      const Pack inside = select(y > 0, select(y < 1, y, 0), 0);
      psi -= stiffness * inside * inside * log1p(-inside);
      psi = select(y < 1, psi, std::numeric_limits<double>::infinity());
    }
    return psi;
  }

  PlaneDerivatives derivatives(const PackVec2& s) const {
    PlaneDerivatives d;
    for (int i = 0; i < 2; ++i) {
      const Pack y = (s(i) - start) / range;
      const Pack inside = select(y > 0, y, 0), left = 1 - inside, log_left = log1p(-inside);
      d.gradient(i) = stiffness / range * inside * (inside / left - 2 * log_left);
      d.hessian(i, i) = stiffness / (range * range) * (inside * (4 + inside / left) / left - 2 * log_left);
    }
    d.hessian(0, 1) = d.hessian(1, 0) = 0;
    return d;
  }

  static constexpr LimitNames limit_names{"the principal strain", "strain"};
  LimitUse limit_use(std::span<const double> stretches) const { return {stretches[0] - 1, start + range - 1}; }
};

class StrainLimitEnergy : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    f.number("strain", strain_, units::none, "largest principal strain (stretch minus 1), which no triangle reaches").required().positive();
    f.number("start", start_, units::none, "fraction of that strain at which the sheet begins to stiffen").range(0, 0.999);
    f.number("stiffness", stiffness_, units::pressure,
             "k of -k y^2 ln(1 - y), y the fraction of the way from the start to the limit; Young's modulus of the sheet is a fair value").required().positive();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    require_sheet(body, rest, type());
    return std::make_unique<LimitedTerm<MembraneTerm<StrainLimit>, Triangle>>(
        std::string(type()), StrainLimit{1 + start_ * strain_, (1 - start_) * strain_, stiffness_}, body, rest);
  }

 private:
  double strain_ = 0.1, start_ = 0.8;
  double stiffness_ = 1e5;  // Pa
};

TACK_REGISTER(Energy, StrainLimitEnergy, "strain_limit",
              "Strain limit of a sheet, beside its membrane: principal strains stay below it. Without mass and without resistance before its start.",
              "Li, Kaufman and Jiang 2021, Codimensional Incremental Potential Contact, section 5");

}  // namespace
}  // namespace tack
