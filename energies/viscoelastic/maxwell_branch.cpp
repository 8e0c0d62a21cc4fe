// The energy `maxwell`.
#include <fmt/format.h>

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
    f.number("modulus", parameters_.modulus, units::pressure, "shear modulus of the spring").required().positive();
    f.number("bulk", parameters_.bulk, units::pressure, "bulk modulus of the spring; linear tets only").at_least(0);
    f.number("time", parameters_.time, units::time, "relaxation time: the stress at constant strain falls by 1/e").required().positive();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    if (body.elements != Elements::linear && parameters_.bulk > 0)
      throw InputError(fmt::format("object '{}': a maxwell branch with a bulk modulus needs linear tets, because it would lock the volume of others; leave out `bulk`, or `elements`",
                                   body.name));
    const std::string name(type());
    if (body.elements == Elements::composite) return std::make_unique<CompositeMaxwell>(name, parameters_, body, rest);
    return std::make_unique<MaxwellTets>(name, parameters_, body, rest);  // patches: a branch has no volume of its own
  }
  bool takes_elements() const override { return true; }

 private:
  MaxwellParameters parameters_;
};

TACK_REGISTER(Energy, MaxwellBranch, "maxwell",
              "Spring and dashpot in series, beside the energy of a solid: relaxation. Without mass. Several make a Prony series.",
              "Simo 1987; Reese and Govindjee 1998");

}  // namespace
}  // namespace tack
