// The energy `maxwell`.
#include <fmt/format.h>

#include "energies/viscoelastic/branch_parameters.hpp"
#include "energies/viscoelastic/maxwell_term.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class MaxwellBranch : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    branch_.stiffness_fields(f);
    f.optional_number("bulk", bulk_, units::pressure, "bulk modulus of the spring, 0 unless given; linear tets only").at_least(0);
    f.optional_number("bulk_fraction", bulk_fraction_, units::none, "bulk modulus of the spring over that of the energy beside it, instead of bulk").at_least(0);
    branch_.time_fields(f);
    f.check("bulk", [this]() -> std::string { return bulk_ && bulk_fraction_ ? "and bulk_fraction: give one of the two" : ""; });
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    const MaxwellParameters parameters{branch_.shear(body, type()), bulk(body), branch_.time, branch_.shift};
    if (body.elements != Elements::linear && parameters.bulk > 0)
      throw InputError(fmt::format("object '{}': a maxwell branch with a bulk modulus needs linear tets, because it would lock the volume of others; leave out `bulk` (or `bulk_fraction`), or `elements`",
                                   body.name));
    const std::string name(type());
    if (body.elements == Elements::composite) return std::make_unique<CompositeMaxwell>(name, parameters, body, rest);
    return std::make_unique<MaxwellTets>(name, parameters, body, rest);  // patches: a branch has no volume of its own
  }
  bool takes_elements() const override { return true; }

  bool depends_on_temperature() const override { return branch_.shift.shifts(); }

 private:
  // Returns the bulk modulus of the spring [Pa].
  double bulk(const Body& body) const {
    if (!bulk_fraction_) return bulk_.value_or(0);
    const Energy& base = base_of(body, type(), "`modulus` and `bulk`");
    const std::optional<double> poisson = base.poisson();
    if (!poisson) throw InputError(fmt::format("object '{}': maxwell takes a fraction of the bulk modulus of {}, which has no Poisson's ratio; give `bulk`", body.name, base.type()));
    return *bulk_fraction_ * 2 * *base.shear() * (1 + *poisson) / (3 * (1 - 2 * *poisson));
  }

  BranchParameters branch_;
  std::optional<double> bulk_, bulk_fraction_;  // Pa, 1
};

TACK_REGISTER(Energy, MaxwellBranch, "maxwell",
              "Spring and dashpot in series, beside the energy of a solid: relaxation. Without mass. Several make a Prony series.",
              "Simo 1987; Reese and Govindjee 1998");

}  // namespace
}  // namespace tack
