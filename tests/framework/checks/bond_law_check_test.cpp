#include "framework/checks/bond_law_check.hpp"

#include <catch2/catch.hpp>

#include "tests/support/bond_laws.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;

namespace {

// As docs/extending.md has it: damage D = k / (4 W) dissipates W D^2. What it states may be wrong by factors.
class Fading : public BondLawOf<Fading> {
 public:
  struct HistoryVariables {
    double damage = 0;
  };
  Fading(double slope, double curvature, double loss, double peak, double work = 1) : slope_(slope), curvature_(curvature), loss_(loss), peak_(peak), work_(work) {}
  void prepare(const PairMaterials&) override {}
  double peak_traction() const override { return peak_ * 4 * std::sqrt(1e8 / 27); }
  double work_of_adhesion() const override { return work_; }
  template <class T>
  T energy(const T& d, const T& s, const HistoryVariables& m, double h) const {
    const T pulled = T(1e8) * (d * d + s);
    const double k = value_of(pulled), damage = h > 0 ? std::clamp(k / 4, m.damage, 1.0) : m.damage;
    const bool grows = damage > m.damage && damage < 1;
    return chained(pulled, (1 - damage) * k / 2 + damage * damage - m.damage * m.damage, slope_ * (1 - damage) / 2, grows ? -curvature_ / 8 : 0);
  }
  HistoryVariables after(const HistoryVariables& m, const BondState& at) const { return {std::clamp(1e8 * (at.d * at.d + at.s) / 4, m.damage, 1.0)}; }
  double loss(const HistoryVariables& before, const HistoryVariables& after, const BondState&) const {
    return loss_ * (after.damage * after.damage - before.damage * before.damage);
  }
  bool gone(const HistoryVariables& m, const BondState&) const { return m.damage == 1; }

 private:
  double slope_, curvature_, loss_, peak_, work_;
};

}  // namespace

TEST_CASE("consistent bond laws give no warnings", "[law_check]") {
  const std::vector<std::map<std::string, std::string>> settings = {{},
                                                                    {{"viscosity", "0.02"}},
                                                                    {{"intensity", "0.4"}},
                                                                    {{"law", "{type: bilinear, peak_traction: 1e4, work_of_adhesion: 1}"}},
                                                                    {{"activation_energy", "6e4"}},
                                                                    {{"tangential_strength", "2e4"}, {"tangential_work", "3"}},
                                                                    {{"envelope", "{type: table, file: " TACK_TEST_DATA "/laws/six_rows.csv}"}}};
  for (const ComponentVariant& v : variants<AdhesionLaw, BondLaw>(settings)) {
    INFO(v.yaml);
    const LawCheck check = check_law(*bond_law(v.yaml));
    CHECK(check.errors.empty());
    CHECK(check.warnings.empty());
  }
  const LawCheck check = check_law(Fading(1, 1, 1, 1));
  CHECK((check.errors.empty() && check.warnings.empty()));
}

TEST_CASE("a bond law with wrong derivatives, losses, peak or work is reported", "[law_check]") {
  const auto wrong = [](const Fading& law) {
    const LawCheck check = check_law(law);
    CHECK(check.warnings.empty());
    return check.errors;
  };
  const auto doubtful = [](const Fading& law) {
    const LawCheck check = check_law(law);
    CHECK(check.errors.empty());
    return check.warnings;
  };
  CHECK_THAT(only_text(wrong(Fading(1, 0.9, 1, 1)), WarningKind::law_derivatives), Contains("second derivatives"));
  only_text(wrong(Fading(1, 1, 0.9, 1)), WarningKind::law_dissipation);
  CHECK_THAT(only_text(doubtful(Fading(1, 1, 1, 1.1)), WarningKind::law_statement), Contains("peak traction of 8468 Pa, and has 7698"));
  CHECK_THAT(only_text(doubtful(Fading(1, 1, 1, 1, 1.1)), WarningKind::law_statement), Contains("work of adhesion of 1.1 J/m^2, and has 1 "));
  const LawCheck slope = check_law(Fading(1.01, 1.01, 1, 1));
  CHECK_THAT(first_text(slope.errors, WarningKind::law_derivatives), Contains("tractions are not the derivatives of its energy"));
}
