// The energies `maxwell_rod` and `maxwell_bending`: fractions of an elastic rod, a string or the bending of a sheet that relax.
#include <fmt/format.h>

#include "energies/viscoelastic/strain_branch.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"
#include "framework/scene/strain_energy.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class StrainBranchEnergy : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    f.number("fraction", fraction_, units::none, "stiffness of the springs over that of the energy beside it").required().positive();
    f.number("time", time_, units::time, "relaxation time: the stress at constant strain falls by 1/e").required().positive();
    shift_.fields(f, "time");
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    if (shift_.shifts() && body.environment && !body.environment->uniform())
      throw InputError(fmt::format("object '{}': {} has one temperature, and environment.profile gives one for each position; take `profile` or `shift` away", body.name, type()));
    return std::make_unique<StrainBranch>(std::string(type()), fmt::format("{}/energies/{}/relaxed_strains", body.name, body.energy), base(body).make_scaled(body, rest, fraction_),
                                          time_, ShiftedTimes(shift_, body, std::vector<Edge>(), rest));
  }
  bool depends_on_temperature() const override { return shift_.shifts(); }

 private:
  const StrainEnergy& base(const Body& body) const {
    const StrainEnergy* found = nullptr;
    int count = 0;
    for (const auto& energy : body.energies)
      if (const auto* strained = dynamic_cast<const StrainEnergy*>(energy.get()); strained && strained->branch() == type()) found = strained, ++count;
    if (count != 1)
      throw InputError(fmt::format("object '{}': {} takes a fraction of the stiffness of the energy beside it, {}, and the object has {} of these; give it one", body.name, type(),
                                   type() == "maxwell_rod" ? "`elastic_rod` or `string`" : "`hinge_bending`", count == 0 ? std::string("none") : std::to_string(count)));
    return *found;
  }

  double fraction_ = 1, time_ = 1;  // 1, s
  TemperatureShift shift_;
};

class MaxwellRod : public StrainBranchEnergy {};
class MaxwellBending : public StrainBranchEnergy {};

TACK_REGISTER(Energy, MaxwellRod, "maxwell_rod",
              "Springs and dashpots in series, beside the stretching, bending and twisting of a rod or string: relaxation. Without mass. Several make a Prony series.",
              "Taylor, Pister, Goudreau 1970");
TACK_REGISTER(Energy, MaxwellBending, "maxwell_bending", "Springs and dashpots in series, beside the bending of a sheet: relaxation. Without mass. Several make a Prony series.",
              "Taylor, Pister, Goudreau 1970");

}  // namespace
}  // namespace tack
