#include "energies/plasticity/von_mises.hpp"

#include "energies/plasticity/flow_parameters.hpp"
#include "energies/plasticity/von_mises_term.hpp"

namespace tack {
namespace {

class VonMisesSolid : public SolidEnergy {
 public:
  void fields(Fields& f) override {
    SolidEnergy::fields(f);
    flow_.fields(f, "bar");
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    const VonMises material{lame(), flow_.yield_stress, flow_.hardening, flow_.viscosity};
    const std::string name(type());
    if (body.elements != Elements::linear) return make_grouped_von_mises(name, material, body, rest);
    return std::make_unique<VonMisesTerm<SolidTerm<VonMises>>>(body, name, material, body, rest);
  }
  bool takes_elements() const override { return true; }

 private:
  FlowParameters flow_;
};

TACK_REGISTER(Energy, VonMisesSolid, "von_mises",
              "Elastoplastic solid in Hencky strain with the von Mises yield criterion.",
              "Li, Li, Jiang 2022, Energetically Consistent Inelasticity");

}  // namespace
}  // namespace tack
