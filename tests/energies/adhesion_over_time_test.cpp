// Modifiers of bond laws: a factor times another law, over time, temperature or the time in contact.
#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/bond_laws.hpp"

using namespace tack;

namespace {

const std::string bilinear = "{type: bilinear, peak_traction: 1e4, work_of_adhesion: 1, stiffness: 1e8}";

BondSample sample(const BondLaw& law, double d, double u, const double* history, const SiteState& site) {
  return law.at(d, u * u, history, BondStepStates(0.1, &site));
}

void check_factor(const BondLaw& law, const SiteState& site, double factor) {
  const auto whole = bond_law(bilinear);
  std::vector<double> history(law.width()), of_whole(whole->width());
  law.initialize(false, history.data());
  whole->initialize(false, of_whole.data());
  const BondSample scaled = sample(law, 6e-5, 3e-5, history.data(), site), at = sample(*whole, 6e-5, 3e-5, of_whole.data(), site);
  CHECK(scaled.value == Approx(factor * at.value));
  CHECK(scaled.by_d == Approx(factor * at.by_d));
  CHECK(scaled.by_s == Approx(factor * at.by_s));
  CHECK(scaled.by_dd == Approx(factor * at.by_dd));
  CHECK(scaled.by_ds == Approx(factor * at.by_ds).margin(1e-9));
}

}  // namespace

TEST_CASE("over_time and over_temperature are a factor times another law, and may be nested", "[bonds][over_time]") {
  const std::string clock = "{type: over_time, factor: [[1, 1], [3, 0.5]], law: " + bilinear + "}";
  const std::string both = "{type: over_temperature, temperatures: [300, 320], factors: [1, 0.2], law: " + clock + "}";
  SiteState site;
  site.time = 2, site.temperature = 310;
  check_factor(*bond_law(clock), site, 0.75);
  check_factor(*bond_law(both), site, 0.75 * 0.6);
  CHECK(bond_law(both)->depends_on_temperature());
  CHECK_FALSE(bond_law(clock)->depends_on_temperature());
  CHECK(bond_law(clock)->abrupt_times() == std::vector<double>{1, 3});
  CHECK(bond_law(both)->clone()->width() == bond_law(bilinear)->width());
}

TEST_CASE("a modified law depends on the direction of the slip if its law does", "[bonds][over_time]") {
  const std::string viscoelastic = "{type: viscoelastic, peak_traction: 1e4, work_of_adhesion: 1, relaxation_time: 3e-3}";
  const auto law = bond_law("{type: over_time, factor: 0.5, law: " + viscoelastic + "}"), whole = bond_law(viscoelastic);
  REQUIRE(law->directed());
  std::vector<double> history(law->width());
  law->initialize(false, history.data());
  const Vec3 jump(2e-5, 1e-5, -3e-5);
  const SiteState site;
  DirectedSample scaled, at;
  law->add_directed_samples(1, &jump, history.data(), BondStepStates(1e-3, &site), &scaled);
  whole->add_directed_samples(1, &jump, history.data(), BondStepStates(1e-3, &site), &at);
  CHECK(scaled.value == Approx(0.5 * at.value));
  CHECK((scaled.gradient - 0.5 * at.gradient).norm() <= 1e-12 * at.gradient.norm());
  CHECK((scaled.hessian - 0.5 * at.hessian).norm() <= 1e-12 * at.hessian.norm());
  double value = 0;
  law->add_directed_values(1, &jump, history.data(), BondStepStates(1e-3, &site), &value);
  CHECK(value == Approx(scaled.value));
}

TEST_CASE("after_dwell grows with the time under pressure, and books what it adds", "[bonds][over_time]") {
  const auto law = bond_law("{type: after_dwell, times: [0, 10], factors: [0.5, 1], pressure: 100, law: " + bilinear + "}");
  CHECK(law->bonds_on_contact());
  CHECK(law->peak_traction() == Approx(1e4));
  std::vector<double> history(law->width());
  law->initialize(true, history.data());
  check_factor(*law, {}, 0.5);
  const double d = 5e-5, stored = 1e8 * d * d / 2;
  // Not pressed: its time does not count.
  CHECK(law->advance(law->assumed_state(d, 0, 5, 99), history.data()).healed == 0);
  CHECK(law->stored(d, 0, history.data()) == Approx(0.5 * stored));
  const BondChange grown = law->advance(law->assumed_state(d, 0, 5, 100), history.data());
  CHECK(law->stored(d, 0, history.data()) == Approx(0.75 * stored));
  CHECK(grown.healed == Approx(-0.25 * stored));
  CHECK(grown.dissipated == 0);
  // Debonding dissipates the factor times the work of adhesion.
  const BondChange gone = law->advance(law->assumed_state(1e-3, 0, 1, 0), history.data());
  CHECK(gone.gone);
  CHECK(gone.dissipated == Approx(0.75));
}

TEST_CASE("modifiers refuse a law of the gap and tables that are none", "[bonds][over_time]") {
  CHECK_THROWS_AS(bond_law("{type: over_time, factor: 1, law: {type: fang, peak_traction: 1e4}}"), InputError);
  CHECK_THROWS_AS(bond_law("{type: over_time, factor: 0, law: " + bilinear + "}"), InputError);
  CHECK_THROWS_AS(bond_law("{type: after_dwell, times: [0, 0], factors: [1, 1], law: " + bilinear + "}"), InputError);
  CHECK_THROWS_AS(bond_law("{type: over_temperature, temperatures: [300], factors: [1, 1], law: " + bilinear + "}"), InputError);
}
