// Raous-Cangemi-Cocou adhesion integrated as in the paper (eq. 5 to 9), for comparison. The intensity beta is lagged: within a step, a bond is the
// spring k beta^2 / 2. After the step, beta takes a step of explicit Euler, clamped to [0, 1]. With the pressure p between the surfaces less
// the traction of the bond,
//     beta' = min(W - k beta, 0) / eta                              while p < 0,
//     beta' = r max(p - beta p_0, 0) + min(W - C_T beta |u|^2, 0) / eta   else.
// Limits: at a fixed opening beta overshoots for h > eta / k, and is clamped to 0 for little larger steps. Within a step the force has no peak.
// Dissipation is the decrease of the stored energy by the update, k (beta^2 - beta'^2) / 2, so that energy is conserved: the error of the integration
// appears as a work of separation other than W. Dissipation is negative if a bond grows while it is stretched.
#include <algorithm>

#include "energies/adhesion/rcc.hpp"

namespace tack {

class ExplicitRccAdhesion : public RccLawOf<ExplicitRccAdhesion> {
 public:
  ExplicitRccAdhesion() { viscosity_ = 1e-3; }
  void fields(Fields& f) override {
    RccLawOf::fields(f);
    f.number("viscosity", viscosity_, units::surface_viscosity, "eta: viscous resistance to debonding; time steps must be shorter than eta / W").required().positive();
  }
  double longest_step() const override { return viscosity_ / work_; }

  template <class T>
  T energy(const T& d, const T& s, const HistoryVariables& m, double) const {
    return T(m.beta * m.beta / 2) * pull(d, s);
  }
  HistoryVariables after(const HistoryVariables& m, const BondState& at) const {
    const bool pressed = at.pressure > normal_ * m.beta * m.beta * at.d;
    const double k = pull(pressed ? 0.0 : at.d, at.s);
    const double bonding = pressed ? healing_ * std::max(at.pressure - m.beta * saturation_, 0.0) : 0;
    const double rate = bonding + std::min(work_ - k * m.beta, 0.0) / viscosity_;
    return {std::clamp(m.beta + at.h * rate, 0.0, 1.0)};
  }
  double loss(const HistoryVariables& before, const HistoryVariables& after, const BondState& at) const {
    return pull(at.d, at.s) * (before.beta - after.beta) * (before.beta + after.beta) / 2;
  }
  bool gone(const HistoryVariables& m, const BondState& at) const { return m.beta < weak && after(m, at).beta <= m.beta; }
};

TACK_REGISTER(AdhesionLaw, ExplicitRccAdhesion, "rcc_explicit",
              "Raous-Cangemi-Cocou adhesion with the intensity lagged within a step and integrated explicitly; a baseline for `rcc`.", "Fang et al., eq. 5-9");

}  // namespace tack
