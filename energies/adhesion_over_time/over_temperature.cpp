// Adhesion that depends on the temperature of its site: g(T) times a bond law (scaled_bond.hpp), with
// the temperature at the end of each step. Heating a stretched bond changes its energy:
// work_environment.
#include "energies/adhesion_over_time/factor_table.hpp"
#include "energies/adhesion_over_time/scaled_bond.hpp"
#include "framework/config/thermal_units.hpp"

namespace tack {

class AdhesionOverTemperature : public ScaledBondOf<AdhesionOverTemperature> {
 public:
  static constexpr int own_width = 0;
  static constexpr bool of_site = true;

  void fields(Fields& f) override {
    law_field(f);
    f.numbers("temperatures", table_.at, units::temperature, "ascending temperatures (environment.temperature)").required().positive();
    f.numbers("factors", table_.factors, units::none,
              "g at these temperatures, times the potential of the law: strength, work and stiffness; linear in between, constant outside").required().nonnegative();
    f.check("factors", [this] { return table_.error("temperatures"); });
  }
  bool depends_on_temperature() const override { return true; }
  double factor(const double*, const SiteState& site) const { return table_(site.temperature); }
  double largest_factor() const { return table_.largest(); }
  void begin_own(bool, double*) const {}
  void advance_own(const BondState&, double*) const {}

 private:
  FactorTable table_{{room_temperature}, {1}};
};

TACK_REGISTER(AdhesionLaw, AdhesionOverTemperature, "over_temperature", "Another law of bonds times a factor over temperature.", "");

}  // namespace tack
