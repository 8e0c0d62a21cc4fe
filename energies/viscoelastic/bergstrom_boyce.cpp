// The energy `bergstrom_boyce`.
#include "energies/viscoelastic/bergstrom_boyce.hpp"

#include "energies/viscoelastic/branch_parameters.hpp"
#include "energies/viscoelastic/network_term.hpp"

namespace tack {
namespace {

class BergstromBoyceNetwork : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    branch_.stiffness_fields(f);
    f.number("flow_stress", stress_, units::pressure, "sigma_0: equivalent (von Mises, Kirchhoff) stress of the network at which it flows at flow_rate; that of a bar in tension").required().positive();
    f.number("flow_rate", rate_, units::rate, "d_0: equivalent rate of viscous strain at flow_stress, before the factor of strain_exponent; that of a bar in tension").required().positive();
    f.number("exponent", exponent_, units::none, "m: the flow rate is proportional to the m-th power of the stress. 1: a Newtonian dashpot, as that of maxwell").required().at_least(1);
    f.number("strain_exponent", chain_exponent_, units::none,
             "C: the flow rate is multiplied by (lambda_v - 1 + strain_offset)^C, lambda_v the stretch of chains by viscous flow at the start of the step. 0: no such factor").range(-1, 0);
    f.number("strain_offset", chain_offset_, units::none, "xi of strain_exponent").positive();
    branch_.shift.fields(f, "flow_rate");
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    // In tension sigma = sqrt(6) mu |dev e| and |D_v| = sqrt(3/2) d.
    const double mu = branch_.shear(body, type());
    const NetworkFlow flow{mu, stress_ / (std::sqrt(6.0) * mu), std::sqrt(1.5) * rate_, exponent_, chain_exponent_, chain_offset_};
    const std::string name(type());
    if (body.elements == Elements::composite) return std::make_unique<CompositeNetwork>(name, flow, branch_.shift, body, rest);
    return std::make_unique<NetworkTets>(name, flow, branch_.shift, body, rest);  // patches: a network has no volume of its own
  }
  bool takes_elements() const override { return true; }
  bool depends_on_temperature() const override { return branch_.shift.shifts(); }

 private:
  BranchParameters branch_;
  double stress_ = 1e4, rate_ = 1, exponent_ = 4, chain_exponent_ = 0, chain_offset_ = 0.01;  // Pa, 1/s, 1, 1, 1
};

TACK_REGISTER(Energy, BergstromBoyceNetwork, "bergstrom_boyce",
              "Network of springs that flow by a power of their stress, beside the energy of a solid: hysteresis of rubber. Without mass. Several add up.",
              "Bergstrom and Boyce 1998; Reese and Govindjee 1998; Ortiz and Stainier 1999");

}  // namespace
}  // namespace tack
