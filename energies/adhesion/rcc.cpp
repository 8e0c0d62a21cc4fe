// Raous-Cangemi-Cocou adhesion with its intensity beta condensed (the paper, eq. 5, 6 and 8). With k = C_N d^2 + C_T |u|^2 [J/m^2]
// and e = eta / h, a step from beta has
//     phi = min over 0 <= b <= beta of  k b^2 / 2 + W (beta - b) + e/2 (beta - b)^2  =  k beta^2 / 2 - <k beta - W>^2 / (2 (k + e)),
//     b = beta - <k beta - W> / (k + e),     d phi / d k = b^2 / 2.
// Its stationarity is implicit Euler of eta beta' = min(W - k beta, 0): never below 0, whatever the step. phi is C1 and concave in k.
// Slow loading: onset at d = sqrt(W / C_N), peak sqrt(W C_N), beta = W / k beyond it, work W.
// Under a pressure p a bond heals after the step, beta' = r <p - beta p_0> (eq. 9), exactly for a constant p.
#include <algorithm>
#include <cmath>

#include "framework/bond/bond_law.hpp"
#include "framework/config/field.hpp"

namespace tack {

class RccAdhesion : public BondLawOf<RccAdhesion> {
 public:
  struct Memory {
    double beta = 1;
  };

  void fields(Fields& f) override {
    f.number("normal_stiffness", normal_, units::traction_stiffness, "C_N").required().positive();
    f.number("tangential_stiffness", across_, units::traction_stiffness, "C_T").nonnegative();
    f.number("work_of_adhesion", work_, units::work_of_adhesion, "W").required().nonnegative();
  }
  void prepare(const PairMaterials&) override {}
  double peak_traction() const override { return std::sqrt(work_ * normal_); }
  double work_of_adhesion() const override { return work_; }

  template <class T>
  T energy(const T& d, const T& s, const Memory& m, double h) const {
    const T k = T(normal_) * d * d + T(across_) * s;
    const T held = T(m.beta * m.beta / 2) * k, excess = T(m.beta) * k - T(work_);
    if (h == 0 || !(excess > T(0))) return held;
    return held - excess * excess / (T(2) * (k + T(viscosity_ / h)));
  }
  Memory after(const Memory& m, const BondPlace& at) const {
    const double k = normal_ * at.d * at.d + across_ * at.s, excess = m.beta * k - work_;
    return {excess > 0 ? m.beta - excess / (k + viscosity_ / at.h) : m.beta};
  }
  double loss(const Memory& before, const Memory& after, const BondPlace& at) const {
    const double lost = before.beta - after.beta;
    return work_ * lost + viscosity_ * lost * lost / at.h;
  }
  double intensity(const Memory& m) const { return m.beta; }
  bool gone(const Memory& m, const BondPlace&) const { return m.beta < 0.01; }

 private:
  double normal_ = 0, across_ = 0, work_ = 0, viscosity_ = 0;
};

TACK_REGISTER(AdhesionLaw, RccAdhesion, "rcc", "Raous-Cangemi-Cocou adhesion: bonds whose intensity falls where they are pulled.",
              "Fang et al., eq. 5-9; Raous, Cangemi and Cocou 1999");

}  // namespace tack
