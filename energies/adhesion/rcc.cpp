// Raous-Cangemi-Cocou adhesion with its intensity beta condensed (the paper, eq. 5, 6, 8 and 9). With k = C_N d^2 + C_T |u|^2 [J/m^2]
// and e = eta / h, a step from beta has
//     phi = min over 0 <= b <= beta of  k b^2 / 2 + W (beta - b) + e/2 (beta - b)^2
//         = k beta^2 / 2                                            up to k = W / beta, the onset,
//         = (k (e beta^2 + W beta) + W (k beta - W)) / (2 (k + e))  beyond it, b = (W + e beta) / (k + e),  d phi / d k = b^2 / 2.
// Its stationarity is implicit Euler of eta beta' = min(W - k beta, 0), which stays above 0 for any step size. phi is C1 and concave in k.
// Slow loading: onset at d = sqrt(W / C_N), peak sqrt(W C_N), beta = W / k beyond it, work W. With W = 0 any pull debonds, against viscosity alone.
//
// Healing: under a pressure p, beta' = r <p - beta p_0> after the step, exact for a constant p. New bond material is unstressed: it adds the stiffness
// C (beta'^2 - beta^2) to that of the old bond, C beta^2, and does not change the force. One bond of intensity beta' with the fraction
// (beta / beta')^2 of opening and slip has the same force. The difference in energy, k beta^2 / 2 (1 - (beta / beta')^2), is lost.
// Healing thus adds no energy, and a bond that wore out in sliding heals to a new bond where it comes to rest.
#include <algorithm>

#include "energies/adhesion/rcc.hpp"

namespace tack {

class RccAdhesion : public RccLawOf<RccAdhesion> {
 public:
  void fields(Fields& f) override {
    RccLawOf::fields(f);
    f.number("viscosity", viscosity_, units::surface_viscosity, "eta: viscous resistance to debonding").nonnegative();
  }

  template <class T>
  T energy(const T& d, const T& s, const HistoryVariables& m, double h) const {
    const T pulled = pull(d, s);
    const double k = value_of(pulled), excess = m.beta * k - work_;
    if (h == 0 || !(excess > 0)) return T(m.beta * m.beta / 2) * pulled;
    const double e = viscosity_ / h, b = debonded(m.beta, k, e);
    return chained(pulled, (k * m.beta * (e * m.beta + work_) + work_ * excess) / (2 * (k + e)), b * b / 2, -b * b / (k + e));
  }
  HistoryVariables after(const HistoryVariables& m, const BondState& at) const {
    const double k = pull(at.d, at.s);
    return {m.beta * k > work_ ? std::min(m.beta, debonded(m.beta, k, viscosity_ / at.h)) : m.beta};
  }
  double loss(const HistoryVariables& before, const HistoryVariables& after, const BondState& at) const {
    const double lost = before.beta - after.beta;
    return work_ * lost + viscosity_ * lost * lost / at.h;
  }
  HistoryVariables heal(const HistoryVariables& m, const BondState& at) const {
    if (!(healing_ * (at.pressure - m.beta * saturation_) > 0)) return m;
    const double x = healing_ * saturation_ * at.h;
    const double gained = x > 0 ? (at.pressure / saturation_ - m.beta) * -std::expm1(-x) : healing_ * at.pressure * at.h;
    return {std::min(m.beta + gained, 1.0)};
  }
  double kept(const HistoryVariables& before, const HistoryVariables& healed) const { return before.beta / healed.beta * (before.beta / healed.beta); }
  bool gone(const HistoryVariables& m, const BondState& at) const { return m.beta < weak && heal(after(m, at), at).beta <= m.beta; }

 private:
  double debonded(double beta, double k, double e) const { return (work_ + e * beta) / (k + e); }
};

TACK_REGISTER(AdhesionLaw, RccAdhesion, "rcc", "Raous-Cangemi-Cocou adhesion: the bond intensity decreases under tension and heals under pressure.",
              "Fang et al., eq. 5-9; Raous, Cangemi and Cocou 1999");

}  // namespace tack
