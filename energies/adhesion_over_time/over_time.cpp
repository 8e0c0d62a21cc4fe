// Adhesion that is switched or ramped by the clock: g(t) times a bond law, with g at the end of each
// step (scaled_bond.hpp). The work of the switch on stretched bonds, (g' - g) times their energy, is
// work_environment.
#include "energies/adhesion_over_time/scaled_bond.hpp"
#include "framework/config/schedule.hpp"

namespace tack {

class AdhesionOverTime : public ScaledBondOf<AdhesionOverTime> {
 public:
  static constexpr int own_width = 0;
  static constexpr bool of_site = true;

  void fields(Fields& f) override {
    law_field(f);
    f.schedule("factor", factor_, units::none,
               "g over time, times the potential of the law: strength, work and stiffness").required().nonnegative();
    f.check("factor", [this]() -> std::string { return largest_factor() > 0 ? "" : "needs a number above 0: nothing would adhere at any time"; });
  }
  std::vector<double> abrupt_times() const override {
    std::vector<double> times = law().abrupt_times();
    const std::vector<double> corners = factor_.corners();
    times.insert(times.end(), corners.begin(), corners.end());
    return times;
  }
  double factor(const double*, const SiteState& site) const { return factor_.at(site.time); }
  double largest_factor() const {
    double largest = 0;
    for (const Schedule::Point& p : factor_.points()) largest = std::max(largest, p.value);
    return largest;
  }
  void begin_own(bool, double*) const {}
  void advance_own(const BondState&, double*) const {}

 private:
  Schedule factor_ = 1;
};

TACK_REGISTER(AdhesionLaw, AdhesionOverTime, "over_time", "Another law of bonds times a factor over time.", "");

}  // namespace tack
