// Raous-Cangemi-Cocou adhesion against its closed forms, condensed and as the paper integrates it.
#include <catch2/catch.hpp>

#include "tests/support/bond_laws.hpp"

using namespace tack;

namespace {

// C_N = 1e8 Pa/m, W = 1 J/m^2: onset at 0.1 mm, peak 10 kPa.
constexpr double stiffness = 1e8, work = 1, onset = 1e-4, peak = 1e4;

std::unique_ptr<BondLaw> rcc(const std::string& more = "", const std::string& type = "rcc") {
  return bond_law("{type: " + type + ", normal_stiffness: 1e8, work_of_adhesion: 1" + more + "}");
}

struct PullResult {
  double peak, work;  // over sqrt(W C_N) and W; work: force at the end of each step times its displacement
};

// Pulls at 1 mm/s to ten times the onset.
PullResult pulled(const std::string& type, double viscosity, double h) {
  const auto law = rcc(", viscosity: " + std::to_string(viscosity), type);
  PulledBond bond(*law);
  bond.pull(1e-3, 0, static_cast<int>(std::lround(1 / h)), h);
  return {bond.peak() / peak, bond.work_of_ends() / work};
}

}  // namespace

TEST_CASE("rcc: onset, peak, intensity and work of slow loading", "[bonds]") {
  const auto law = rcc(", tangential_stiffness: 4e8");
  CHECK(law->peak_traction() == Approx(peak));
  CHECK(law->work_of_adhesion() == work);
  PulledBond before(*law);
  before.pull(onset * 0.9999, 0, 100, 1e-2);
  CHECK(before.intensity() == 1);
  CHECK(before.traction() == Approx(stiffness * onset * 0.9999));
  for (const double angle : {0.0, 0.3, 1.0, 1.57}) {
    PulledBond bond(*law);
    const double d = std::cos(angle), u = std::sin(angle), per = stiffness * (d * d + 4 * u * u);  // k per unit displacement
    for (const double way : {0.4, 1.2, 2.0, 3.0}) {
      const double x = way * onset, k = per * x * x;
      bond.pull(x * d, x * u, 500, 1e-2);
      const double beta = std::min(1.0, work / k);
      CHECK(bond.intensity() == Approx(beta));
      CHECK(bond.traction() == Approx(beta * beta * stiffness * x * d));
      CHECK(bond.across() == Approx(beta * beta * 4 * stiffness * x * u));
    }
    bond.pull(12 * onset * d, 12 * onset * u, 20000, 1e-2);
    CHECK(bond.change().gone);
    CHECK(bond.work() == Approx(work).epsilon(0.01));
    CHECK(bond.dissipated() == Approx(bond.work()).epsilon(1e-3));
  }
}

TEST_CASE("rcc: at a fixed opening the intensity decays exponentially", "[bonds]") {
  const double eta = 0.05, k = 4 * work;  // at twice the onset
  const auto law = rcc(", viscosity: 0.05");
  for (const double h : {1e-4, 2e-4}) {
    PulledBond bond(*law);
    for (int i = 1; i <= 300; ++i) {
      bond.step(2 * onset, 0, h);
      const double exact = work / k + (1 - work / k) * std::exp(-k * i * h / eta);
      REQUIRE(bond.intensity() == Approx(exact).epsilon(0.01));
    }
  }
  // However large the step, it ends where it must.
  PulledBond bond(*law);
  bond.step(2 * onset, 0, 1e6);
  CHECK(bond.intensity() == Approx(work / k));
}

TEST_CASE("rcc: peak and work do not depend on large steps, unlike those of explicit integration", "[bonds]") {
  for (const double viscosity : {1e-3, 1e-2}) {
    const PullResult exact = pulled("rcc", viscosity, 1e-5), condensed = pulled("rcc", viscosity, 1e-2);
    CHECK(condensed.peak == Approx(exact.peak).epsilon(0.05));
    CHECK(condensed.work == Approx(exact.work).epsilon(0.05));
  }
  const PullResult fine = pulled("rcc_explicit", 1e-3, 1e-4), coarse = pulled("rcc_explicit", 1e-3, 1e-2), coarser = pulled("rcc_explicit", 1e-3, 0.1);
  CHECK(fine.peak == Approx(1.0018).epsilon(1e-3));
  CHECK(fine.work == Approx(1.003).epsilon(1e-3));
  CHECK(coarse.peak == Approx(1.10).epsilon(0.01));
  CHECK(coarse.work == Approx(0.66).epsilon(0.01));
  CHECK(coarser.peak == Approx(2).epsilon(0.01));
  CHECK(coarser.work == Approx(3).epsilon(0.01));
}

TEST_CASE("explicit rcc overshoots at a fixed opening from h > eta / k on", "[bonds]") {
  const double k = 4, eta = 1;  // where the limit is 1/4
  const auto law = rcc(", viscosity: 1", "rcc_explicit");
  const auto end = [&](double h_k_over_eta) {
    PulledBond bond(*law);
    for (int i = 0; i < 200; ++i) bond.step(2 * onset, 0, h_k_over_eta * eta / k);
    return bond.intensity();
  };
  CHECK(end(0.5) == Approx(0.25));
  CHECK(end(1.2) == Approx(0.1));
  CHECK(end(1.4) == 0);
  // Traction and dissipation at the end of a step.
  PulledBond bond(*law);
  CHECK(bond.step(5 * onset, 0, 1e-2).by_d == Approx(5 * peak));
  CHECK(bond.intensity() == Approx(1 - 1e-2 * 24));
  CHECK(bond.change().dissipated == Approx(25 * (1 - 0.76 * 0.76) / 2));
}

TEST_CASE("explicit rcc under pressure heals, and only slip debonds it", "[bonds]") {
  const auto law = rcc(", tangential_stiffness: 1e8, viscosity: 1, healing: 1e-2, saturation: 1e3, intensity: 0.5", "rcc_explicit");
  PulledBond bond(*law);
  bond.step(2 * onset, 4 * onset, 1e-2, 1e9);  // k beta of the slip is 8
  const double rate = 1e-2 * (1e9 - 500) - 7;
  CHECK(bond.intensity() == std::min(1.0, 0.5 + 1e-2 * rate));
  CHECK(bond.change().dissipated < 0);  // the bond is stretched, and its growth stores energy
  PulledBond pulled(*law);
  pulled.step(2 * onset, 0, 1e-2, 100);  // less than it pulls with
  CHECK(pulled.intensity() == Approx(0.5 - 1e-2 * 1));
}

TEST_CASE("rcc without work, viscosity or tangential stiffness", "[bonds]") {
  const auto bond_of = [](const std::string& more) { return bond_law("{type: rcc, normal_stiffness: 1e8, work_of_adhesion: " + more + "}"); };
  {
    const auto law = bond_of("0, viscosity: 0.01");  // any opening reduces the intensity: beta e / (k + e)
    PulledBond bond(*law);
    bond.step(onset, 0, 1e-2);
    CHECK(bond.intensity() == Approx(0.5));
    CHECK(bond.traction() == Approx(0.25 * peak));
  }
  {
    const auto law = bond_of("0");
    PulledBond bond(*law);
    CHECK(bond.step(onset, 0, 1e-2).by_d == 0);
    CHECK((bond.intensity() == 0 && bond.change().gone && bond.change().dissipated == 0));
    CHECK(law->at(0, 0, PulledBond(*law).history(), 1e-2).by_d == 0);
  }
  const auto law = bond_of("1");
  const BondSample s = law->at(2 * onset, 1e-2, PulledBond(*law).history(), 1e-2);
  CHECK((s.by_s == 0 && s.by_ss == 0 && s.by_ds == 0));
}

TEST_CASE("rcc far beyond the onset is as exact as before", "[bonds]") {
  const auto law = rcc(", viscosity: 1e-3");
  const double beta = 0.75, e = 1e-3 / 1e-2, d = 0.5;
  const BondSample s = law->at(d, 0, &beta, 1e-2);
  const long double k = 1e8L * d * d, b = (1 + static_cast<long double>(e) * beta) / (k + e);
  const long double exact = k * b * b / 2 + (beta - b) + e * (beta - b) * (beta - b) / 2;
  CHECK(s.value == Approx(static_cast<double>(exact)).epsilon(1e-14));
  CHECK(s.by_d == Approx(static_cast<double>(b * b * 1e8L * d)).epsilon(1e-13));
}

TEST_CASE("rcc heals exactly under a constant pressure, for any step size", "[bonds]") {
  const auto law = rcc(", healing: 1e-3, saturation: 2 kPa, intensity: 0.1");
  for (const int steps : {1, 7, 300}) {
    PulledBond bond(*law);
    for (int i = 0; i < steps; ++i) bond.step(0, 0, 0.9 / steps, 1500);
    CHECK(bond.intensity() == Approx(0.75 + (0.1 - 0.75) * std::exp(-1e-3 * 2000 * 0.9)));
    for (int i = 0; i < 5; ++i) bond.step(0, 0, 100, 1500);
    CHECK(bond.intensity() == Approx(0.75));
    bond.step(0, 0, 100, 1000);  // below saturation: unchanged
    CHECK(bond.intensity() == Approx(0.75));
    CHECK(bond.dissipated() == 0);
  }
  const auto unsaturated = rcc(", healing: 1e-3, intensity: 0.1");
  PulledBond bond(*unsaturated);
  bond.step(0, 0, 0.2, 1000);
  CHECK(bond.intensity() == Approx(0.3));
  bond.step(0, 0, 2, 1000);
  CHECK(bond.intensity() == 1);
  // Healing of a stretched bond is unstressed: the force stays, and no energy is added.
  PulledBond stretched(*unsaturated);
  stretched.step(0.5 * onset, 0, 0.2, 1000);
  const double kept = stretched.change().kept;
  CHECK(kept == Approx(1. / 9));
  CHECK(stretched.change().healed == Approx(0.25 * 0.01 / 2 * (1 - kept)));
  CHECK(unsaturated->at(kept * 0.5 * onset, 0, stretched.history(), 1).by_d == Approx(stretched.traction()));
}

TEST_CASE("rcc: intensity of new bonds, and failed bonds", "[bonds]") {
  const auto law = rcc(), heals = rcc(", tangential_stiffness: 1e8, healing: 1e-3, saturation: 1 kPa"), given = rcc(", healing: 1e-3, intensity: 0.3");
  CHECK((PulledBond(*law).intensity() == 1 && PulledBond(*law, true).intensity() == 1));
  CHECK((PulledBond(*heals).intensity() == 1 && PulledBond(*heals, true).intensity() == 0));
  CHECK((PulledBond(*given).intensity() == 0.3 && PulledBond(*given, true).intensity() == 0.3));
  CHECK((!law->bonds_on_contact() && heals->bonds_on_contact()));
  PulledBond pressed(*heals, true), free(*heals, true);
  free.step(0, 0, 1e-3, 0);
  CHECK(free.change().gone);
  for (int i = 0; i < 5; ++i) {  // 1e-3 a step at first: weak, and growing
    pressed.step(0, 0, 1e-3, 1000);
    CHECK(!pressed.change().gone);
  }
  CHECK(pressed.intensity() == Approx(1 - std::exp(-5e-3)));
  // A bond that slid far under pressure is worn out, and heals without stress there.
  pressed.step(0, 1e-2, 1e-3, 1000);
  CHECK((!pressed.change().gone && pressed.change().kept < 0.01));
}

TEST_CASE("rcc refuses contradictory parameters", "[bonds]") {
  CHECK_THROWS_WITH(rcc(", intensity: 1.5"), Catch::Contains("intensity"));
  CHECK_THROWS_WITH(rcc(", viscosity: 0", "rcc_explicit"), Catch::Contains("viscosity"));
  CHECK_THROWS_WITH(rcc(", healing: 1 Pa"), Catch::Contains("a rate per pressure (1/(Pa s))"));
}
