// Adhesion with irreversible damage against its closed forms: loading, unloading, reloading, mixed modes, viscosity.
#include <catch2/catch.hpp>
#include <numbers>

#include "tests/support/bond_laws.hpp"

using namespace tack;

namespace {

// sigma = 10 kPa, W = 1 J/m^2. bilinear: onset at 0.02 mm, end at 0.2 mm. exponential: d_0 = 1 / (e 1e4) m.
const std::string strength = ", peak_traction: 10 kPa, work_of_adhesion: 1";

double bilinear(double d, double largest) {
  const double onset = 2e-5, end = 2e-4, x = std::max(onset, largest);
  return x < end ? 1e4 * (end - x) / (end - onset) * d / x : 0;
}

double exponential(double d, double largest) {
  const double scale = 1e-4 / std::numbers::e;
  return 1e4 * d / scale * std::exp(1 - largest / scale);
}

std::unique_ptr<BondLaw> law_of(const std::string& type, const std::string& more = "") { return bond_law("{type: " + type + strength + more + "}"); }

struct Shape {
  std::string type;
  double (*traction)(double d, double largest);
};
const std::vector<Shape> shapes = {{"bilinear", bilinear}, {"exponential", exponential}};

const std::string modes = ", tangential_strength: 20 kPa, tangential_work: 3";

// The work of parting along a ray, the angle from the normal.
double work_along(const BondLaw& law, double angle) {
  PulledBond bond(law);
  bond.pull(5e-3 * std::cos(angle), 5e-3 * std::sin(angle), 40000, 1e-2);
  CHECK(bond.change().gone);
  CHECK(bond.dissipated() == Approx(bond.work()).epsilon(2e-3));
  return bond.work();
}

}  // namespace

TEST_CASE("damage: loading, unloading through the origin and reloading", "[bonds]") {
  for (const auto& [type, traction] : shapes) {
    INFO(type);
    const auto law = law_of(type);
    PulledBond bond(*law);
    double largest = 0, dissipated = 0;
    for (const double turn : {1e-5, 4e-5, 3e-5, 9e-5, 1.5e-4}) {
      for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        const double d = turn * share;
        dissipated = bond.dissipated();
        bond.step(d, 0, 1e-2);
        CHECK(bond.traction() == Approx(traction(d, std::max(largest, d))));
        if (d <= largest) CHECK(bond.dissipated() == dissipated);
        largest = std::max(largest, d);
      }
      bond.step(turn / 2, 0, 1e-2);
      CHECK(bond.traction() == Approx(traction(turn / 2, largest)));
      CHECK(bond.step(0, 0, 1e-2).by_d == 0);
    }
    // The remaining work, equal in all directions.
    PulledBond whole(*law);
    whole.pull(0, 2e-3, 20000, 1e-2);
    CHECK(whole.change().gone);
    CHECK(whole.peak_across() == Approx(1e4).epsilon(1e-3));
    CHECK(whole.work() == Approx(1).epsilon(1e-3));
    CHECK(whole.dissipated() == Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("damage stays constant over a hundred loads", "[bonds]") {
  for (const auto& [type, traction] : shapes) {
    const auto law = law_of(type);
    PulledBond bond(*law);
    bond.step(6e-5, 0, 1e-2);
    const double intensity = bond.intensity(), dissipated = bond.dissipated();
    for (int i = 0; i < 100; ++i) {
      bond.step(0, 0, 1e-2);
      bond.step(6e-5, 0, 1e-2);
    }
    CHECK(bond.intensity() == intensity);
    CHECK(bond.dissipated() == dissipated);
    CHECK(bond.traction() == Approx(traction(6e-5, 6e-5)));
    for (int i = 0; i < 100; ++i) {  // a little farther each time
      bond.step(0, 0, 1e-2);
      bond.step(6e-5 + 1e-7 * (i + 1), 0, 1e-2);
    }
    CHECK(bond.traction() == Approx(traction(7e-5, 7e-5)));
  }
}

TEST_CASE("damage: onset and stiffness", "[bonds]") {
  const auto by_onset = law_of("bilinear", ", onset: 0.05 mm"), by_stiffness = law_of("bilinear", ", stiffness: 2e8");
  for (const auto* law : {by_onset.get(), by_stiffness.get()}) {
    PulledBond bond(*law);
    bond.pull(5e-5, 0, 10, 1e-2);
    CHECK(bond.traction() == Approx(1e4));
    CHECK(bond.dissipated() == 0);
    bond.pull(1.25e-4, 0, 10, 1e-2);
    CHECK(bond.traction() == Approx(5e3));
  }
  CHECK_THROWS_WITH(law_of("bilinear", ", onset: 0.05 mm, stiffness: 2e8"), Catch::Contains("drop one of the two"));
  CHECK_THROWS_WITH(law_of("bilinear", ", onset: 0.2 mm"), Catch::Contains("largest at an opening of 0.0002 m, and the work is done at 0.0002 m"));
}

TEST_CASE("damage: any law of the gap as the envelope", "[bonds]") {
  const auto law = bond_law(
      "{type: damage, tangential_strength: 4e3, "
      "envelope: {type: expression, traction: '1e4 * (d < 2e-5 ? d / 2e-5 * (2 - d / 2e-5) : (2e-4 - d) / 1.8e-4)', range: 2e-4}}");
  const auto envelope = [](double d) { return d < 2e-5 ? 1e4 * d / 2e-5 * (2 - d / 2e-5) : 1e4 * (2e-4 - d) / 1.8e-4; };
  CHECK(law->peak_traction() == Approx(1e4));
  PulledBond bond(*law);
  for (const double d : {1e-6, 1e-5, 3e-5, 9e-5, 1.9e-4}) {
    CHECK(bond.step(d, 0, 1e-2).by_d == Approx(envelope(d)).margin(10));
    CHECK(bond.step(d / 3, 0, 1e-2).by_d == Approx(envelope(d) / 3).margin(10));
    CHECK(bond.step(d, 0, 1e-2).by_d == Approx(envelope(d)).margin(10));
  }
  PulledBond slid(*law);
  slid.pull(0, 1e-3, 20000, 1e-2);
  CHECK(slid.peak_across() == Approx(4e3).epsilon(1e-3));
  CHECK(slid.work() == Approx(law->work_of_adhesion()).epsilon(1e-3));
  CHECK((slid.change().gone && slid.dissipated() == Approx(law->work_of_adhesion()).epsilon(1e-3)));

  const auto refused = [](const std::string& of, const std::string& why) {
    CHECK_THROWS_WITH(bond_law("{type: damage, envelope: " + of + "}"), Catch::Contains(why));
  };
  refused("{type: bonded, peak_traction: 1e4}", "has to be an adhesion of the gap");
  refused("{type: expression, traction: 1e4 * (1 - d / 1e-4), range: 1e-4}", "begins with 1e+04 Pa");
  refused("{type: expression, traction: 1e16 * d^2 * (1e-4 - d), range: 1e-4}", "its traction per opening rises to");
}

TEST_CASE("bonded: no creep, and permanent failure", "[bonds]") {
  const auto law = bond_law("{type: bonded, peak_traction: 10 kPa, tangential_strength: 5 kPa}");
  PulledBond bond(*law);
  for (int i = 0; i < 1000; ++i) bond.step(0.9e-6 * std::cos(i), 0, 1e-2);
  CHECK((bond.intensity() == 1 && bond.dissipated() == 0));
  PulledBond slid(*law);
  slid.pull(0, 2.1e-6, 21000, 1e-2);  // (tau / sigma)^2 K |u| = tau
  CHECK(slid.change().gone);
  CHECK(slid.peak_across() == Approx(5e3).epsilon(1e-3));
  PulledBond both(*law);  // 0.8^2 + 0.59^2 < 1 < 0.8^2 + 0.62^2
  both.step(0.8e-6, 2 * 0.59e-6, 1e-2);
  CHECK(both.intensity() == 1);
  both.step(0.8e-6, 2 * 0.62e-6, 1e-2);
  CHECK((both.change().gone && both.intensity() == 0));
  CHECK(law->work_of_adhesion() == Approx(1e4 * 1e-6 / 2 * 1.001));
  CHECK(bond_law("{type: bonded, peak_traction: 1e4}", {.contact_distance = 1e-4})->work_of_adhesion() == Approx(5e-4 * 1.001));
  CHECK(bond_law("{type: bonded, peak_traction: 1e4, stiffness: 1e9}")->work_of_adhesion() == Approx(5e-2 * 1.001));
}

TEST_CASE("mixed modes: the works of opening, slip and mixed paths satisfy the criterion", "[bonds]") {
  const double quarter = std::numbers::pi / 4;
  for (const std::string type : {"bilinear", "exponential"}) {
    INFO(type);
    // K_T / K: bilinear (tau / sigma)^2, exponential that over the ratio of the works.
    const double ratio = type == "bilinear" ? 4 : 4.0 / 3, mixity = ratio / (1 + ratio);
    for (const double p : {1.0, 2.0}) {
      const auto law = law_of(type, modes + ", mixed_mode: power, mixity_exponent: " + std::to_string(p));
      CHECK(work_along(*law, 0) == Approx(1).epsilon(2e-3));
      CHECK(work_along(*law, 2 * quarter) == Approx(3).epsilon(2e-3));
      CHECK(work_along(*law, quarter) == Approx(std::pow(std::pow(1 - mixity, p) + std::pow(mixity / 3, p), -1 / p)).epsilon(2e-3));
    }
    const auto law = law_of(type, modes + ", mixed_mode: benzeggagh_kenane, mixity_exponent: 1.5");
    CHECK(work_along(*law, 0) == Approx(1).epsilon(2e-3));
    CHECK(work_along(*law, 2 * quarter) == Approx(3).epsilon(2e-3));
    CHECK(work_along(*law, quarter) == Approx(1 + 2 * std::pow(mixity, 1.5)).epsilon(2e-3));
  }
}

TEST_CASE("mixed modes: strengths, and the quadratic onset between them", "[bonds]") {
  const auto law = law_of("bilinear", modes + ", mixed_mode: power, tangential_stiffness: 1e9");
  for (const double angle : {0.0, 0.5, 1.2, 1.5707}) {
    PulledBond bond(*law);
    double normal = 0, across = 0;
    for (double way = 1e-7; bond.intensity() == 1; way += 1e-7) {
      normal = bond.traction(), across = bond.across();
      bond.step(way * std::cos(angle), way * std::sin(angle), 1e-2);
    }
    CHECK(std::hypot(normal / 1e4, across / 2e4) == Approx(1).epsilon(0.02));
  }
}

TEST_CASE("mixed modes: another mixity does not heal", "[bonds]") {
  for (const std::string type : {"bilinear", "exponential"}) {
    const auto law = law_of(type, modes + ", mixed_mode: benzeggagh_kenane");
    PulledBond bond(*law);
    bond.pull(1e-4, 0, 100, 1e-2);
    const double damaged = bond.intensity();
    CHECK(damaged < 0.5);
    bond.pull(0, 0, 10, 1e-2);
    for (int i = 0; i < 50; ++i) {
      const double before = bond.intensity();
      bond.step(2e-5 * (1 + std::cos(i)), 2e-5 * (1 + std::sin(i)), 1e-2);
      CHECK(bond.intensity() <= before);
      CHECK(bond.change().dissipated >= 0);
    }
  }
}

TEST_CASE("damage with viscosity: slow loading without viscous effect, a constant opening by its equation", "[bonds]") {
  const auto law = law_of("bilinear", ", viscosity: 0.02"), without = law_of("bilinear");
  PulledBond slow(*law), still(*without);
  slow.pull(1.2e-4, 0, 2000, 1e3), still.pull(1.2e-4, 0, 2000, 1e3);
  CHECK(slow.traction() == Approx(still.traction()).epsilon(1e-4));
  // eta D' = k / 2 - g'(D), with g' = K x(D)^2 / 2: against small explicit steps.
  const double d = 8e-5, stiffness = 5e8, onset = 2e-5, end = 2e-4;
  double damage = 0;
  PulledBond bond(*law);
  for (int i = 0; i < 400; ++i) {
    bond.step(d, 0, 2e-5);
    for (int j = 0; j < 20; ++j) {
      const double x = onset * end / (end - damage * (end - onset));
      damage += 1e-6 / 0.02 * std::max(0.0, stiffness * (d * d - x * x) / 2);
    }
    CHECK(bond.intensity() == Approx(1 - damage).epsilon(0.01));
  }
  CHECK(bond.intensity() < 0.9);
  // Whatever the step, it ends where slow loading does.
  PulledBond jumped(*law), far(*law);
  jumped.step(d, 0, 1e9);
  CHECK(jumped.traction() == Approx(bilinear(d, d)));
  far.step(1, 0, 1e-5);
  CHECK(far.change().gone);
}

TEST_CASE("damage refuses contradictory parameters", "[bonds]") {
  for (const std::string type : {"bilinear", "exponential"}) {
    CHECK_THROWS_WITH(law_of(type, ", mixed_mode: power"), Catch::Contains("needs tangential_work"));
    CHECK_THROWS_WITH(law_of(type, ", tangential_work: 3"), Catch::Contains("choose mixed_mode"));
    CHECK_THROWS_WITH(law_of(type, ", mixity_exponent: 2"), Catch::Contains("choose mixed_mode"));
    CHECK_THROWS_WITH(law_of(type, modes + ", mixed_mode: power, mixity_exponent: 0.5"), Catch::Contains("at least 1"));
    CHECK_THROWS_WITH(law_of(type, ", tangential_strength: 0, tangential_work: 3, mixed_mode: power"), Catch::Contains("must be positive"));
  }
  CHECK_THROWS_WITH(law_of("bilinear", ", tangential_strength: 1e4, tangential_stiffness: 1e8"), Catch::Contains("drop one of the two"));
}

TEST_CASE("coupled Xu-Needleman: strengths, and recovery without history", "[bonds]") {
  const auto law = law_of("xu_needleman_coupled", ", tangential_strength: 4 kPa");
  PulledBond bond(*law);
  bond.pull(0, 2e-3, 20000, 1e-2);
  CHECK(bond.peak_across() == Approx(4e3).epsilon(1e-4));
  CHECK(bond.work() == Approx(1).epsilon(1e-4));
  bond.pull(1e-4 / std::numbers::e, 0, 20000, 1e-2);
  CHECK(bond.traction() == Approx(1e4));
  CHECK(bond.dissipated() == 0);
  const AdhesionTraits traits = law->traits();
  CHECK((traits.reversible && !traits.history_dependent && traits.normal && traits.tangential));
}
