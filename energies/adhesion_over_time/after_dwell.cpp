// Adhesion that grows with the time in contact: g(a) times a bond law (scaled_bond.hpp), where the age
// a of a bond is the time since it formed, or the part of that in which it was pressed by at least a
// given pressure. A table that is linear in the logarithm of the dwell time is the contact ageing of
// elastomers (Barquins 1992, Adherence, friction and wear of rubber-like materials; Kendall 1975,
// Rolling friction and adhesion between smooth solids: W as a function of the dwell time).
// The age of a step is that at its start, so that the step is a minimum with a constant factor; what
// it grows adds (g' - g) times the energy of a stretched bond: work_healing.
#include "energies/adhesion_over_time/factor_table.hpp"
#include "energies/adhesion_over_time/scaled_bond.hpp"

namespace tack {

class AdhesionAfterDwell : public ScaledBondOf<AdhesionAfterDwell> {
 public:
  static constexpr int own_width = 1;  // a [s]
  static constexpr bool of_site = false;

  void fields(Fields& f) override {
    law_field(f);
    f.numbers("times", table_.at, units::time, "ascending times in contact").required().nonnegative();
    f.numbers("factors", table_.factors, units::none,
              "g after these times, times the potential of the law: strength, work and stiffness; linear in between, constant outside").required().nonnegative();
    f.number("pressure", pressure_, units::pressure, "pressure from which time in contact counts; 0: all time since the bond formed").nonnegative();
    f.number("age_at_start", age_at_start_, units::time, "time in contact of bonds that exist when the run begins").nonnegative();
    f.check("factors", [this] { return table_.error("times"); });
  }
  bool bonds_on_contact() const override { return true; }
  double factor(const double* own, const SiteState&) const { return table_(own[0]); }
  double largest_factor() const { return table_.largest(); }
  void begin_own(bool on_contact, double* own) const { own[0] = on_contact ? 0 : age_at_start_; }
  void advance_own(const BondState& at, double* own) const {
    if (at.pressure >= pressure_) own[0] += at.h;
  }

 private:
  FactorTable table_{{0}, {1}};
  double pressure_ = 0, age_at_start_ = 0;  // Pa, s
};

TACK_REGISTER(AdhesionLaw, AdhesionAfterDwell, "after_dwell", "Another law of bonds times a factor over the time in contact.",
              "Kendall 1975, Rolling friction and adhesion between smooth solids");

}  // namespace tack
