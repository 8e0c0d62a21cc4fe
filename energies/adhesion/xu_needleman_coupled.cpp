// Potential of Xu and Needleman for opening and slip, q = 1: phi = W (1 - (1 + d / l) exp(-d / l - |u|^2 / l_t^2)). The traction
// peaks at sigma = W / (e l) along the normal, at d = l, and at tau = sqrt(2 / e) W / l_t along the surface, at |u| = l_t / sqrt(2). The law has no
// history: bonds are restored when surfaces return, and never fail for good.
#include <numbers>

#include "framework/bond/bond_law.hpp"
#include "framework/config/field.hpp"

namespace tack {

class CoupledXuNeedlemanAdhesion : public BondLawOf<CoupledXuNeedlemanAdhesion> {
 public:
  struct HistoryVariables {};

  void fields(Fields& f) override {
    f.number("peak_traction", strength_, units::pressure, "sigma: the strength along the normal, at the opening W / (e sigma)").required().positive();
    f.number("work_of_adhesion", work_, units::work_of_adhesion, "W: energy to separate unit area, by opening or by slip").required().positive();
    f.optional_number("tangential_strength", tangential_strength_, units::pressure, "tau: the tangential strength; peak_traction unless given. 0: "
                                                                                    "none").nonnegative();
  }
  void prepare(const PairMaterials&) override {
    const double tau = tangential_strength_.value_or(strength_);
    per_opening_ = std::numbers::e * strength_ / work_;
    per_slip_ = std::numbers::e * tau * tau / (2 * work_ * work_);
  }
  double peak_traction() const override { return strength_; }
  double work_of_adhesion() const override { return work_; }
  AdhesionTraits traits() const override { return {.reversible = true, .history_dependent = false, .normal = true, .tangential = true}; }

  template <class T>
  T energy(const T& d, const T& s, const HistoryVariables&, double) const {
    using std::exp;
    const T x = T(per_opening_) * d;
    return T(work_) * (T(1) - (T(1) + x) * exp(-x - T(per_slip_) * s));
  }

 private:
  double strength_ = 1e4, work_ = 1;  // Pa, J/m^2
  std::optional<double> tangential_strength_;
  double per_opening_ = 1e4, per_slip_ = 1e8;  // 1/l [1/m], 1/l_t^2 [1/m^2]
};

TACK_REGISTER(AdhesionLaw, CoupledXuNeedlemanAdhesion, "xu_needleman_coupled", "Reversible cohesive law with one potential of opening and slip, "
                                                                               "which decays exponentially in both.",
              "Xu and Needleman 1993");

}  // namespace tack
