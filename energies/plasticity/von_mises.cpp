#include "energies/plasticity/von_mises.hpp"

#include "energies/plasticity/von_mises_term.hpp"

namespace tack {
namespace {

class VonMisesSolid : public SolidEnergy {
 public:
  void fields(Fields& f) override {
    SolidEnergy::fields(f);
    f.number("yield_stress", yield_stress_, units::pressure, "stress at which a bar in tension begins to flow").required().positive();
    f.number("hardening", hardening_, units::pressure,
             "H: what the yield stress grows by per accumulated plastic strain (equivalent, that of a bar); a bar in tension then "
             "has the tangent modulus E H / (E + H). 0: perfect plasticity").nonnegative();
    f.number("viscosity", viscosity_, units::viscosity,
             "eta: by what the stress exceeds the yield stress per rate of plastic strain (equivalent, that of a bar): sigma = yield_stress + "
             "hardening a + viscosity da/dt, of Perzyna. 0: flow as fast as it is led").nonnegative();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    const VonMises material{lame(), yield_stress_, hardening_, viscosity_};
    const std::string name(type());
    if (body.elements != Elements::linear) return make_grouped_von_mises(name, material, body, rest);
    return std::make_unique<VonMisesTerm<SolidTerm<VonMises>>>(body, name, material, body, rest);
  }
  bool takes_elements() const override { return true; }

 private:
  double yield_stress_ = 1e3;  // Pa
  double hardening_ = 0;       // Pa
  double viscosity_ = 0;       // Pa s
};

TACK_REGISTER(Energy, VonMisesSolid, "von_mises",
              "Solid in Hencky strain that flows plastically from a yield stress on, of von Mises.",
              "Li, Li, Jiang 2022, Energetically Consistent Inelasticity");

}  // namespace
}  // namespace tack
