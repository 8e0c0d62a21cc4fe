// Viscoelastic bonds against the closed forms of a standard linear solid.
#include <catch2/catch.hpp>

#include "tests/support/bond_laws.hpp"

using namespace tack;

namespace {

// sigma = 10 kPa, W = 1 J/m^2, K = 1e8 Pa/m: onset at 0.1 mm, end at 0.2 mm.
constexpr double strength = 1e4, work = 1, stiffness = 1e8, onset = 1e-4, last = 2e-4, relaxation = 0.05;

std::unique_ptr<BondLaw> viscoelastic(double branch, const std::string& more = "") {
  return bond_law("{type: viscoelastic, peak_traction: 1e4, work_of_adhesion: 1, stiffness: 1e8, relaxation_time: 0.05, branch_stiffness: " + std::to_string(branch) + more + "}");
}

PulledBond pulled(const BondLaw& law, double speed, int steps) {
  PulledBond bond(law);
  bond.pull(1.01 * last, 0, steps, 1.01 * last / speed / steps);
  return bond;
}

}  // namespace

TEST_CASE("viscoelastic: slowly it is the bilinear law, fast that of the stiffness K + K_1", "[bonds]") {
  for (const double branch : {0.0, 1e8, 3e8}) {
    const auto law = viscoelastic(branch);
    const double gain = std::sqrt(1 + branch / stiffness), speed = last / relaxation;
    const PulledBond slow = pulled(*law, 1e-6 * speed, 20000), fast = pulled(*law, 1e6 * speed, 20000);
    CHECK(slow.peak() == Approx(strength).epsilon(1e-3));
    CHECK(fast.peak() == Approx(gain * strength).epsilon(1e-3));
    for (const PulledBond* bond : {&slow, &fast}) {
      CHECK(bond->work() == Approx(work).epsilon(2e-3));
      CHECK(bond->dissipated() == Approx(work).epsilon(2e-3));
      CHECK(bond->change().gone);
    }
    const PulledBond middle = pulled(*law, speed, 20000);
    CHECK(middle.dissipated() == Approx(middle.work()).epsilon(2e-3));
    if (branch > 0) CHECK(middle.work() > 1.1 * work);
  }
}

TEST_CASE("viscoelastic: a steady opening before damage", "[bonds]") {
  const auto law = viscoelastic(3e8);
  const double end = 0.3 * onset, time = 0.1, speed = end / time;  // two relaxation times
  PulledBond bond(*law);
  for (int i = 1; i <= 10; ++i) {
    bond.pull(end * i / 10, 0, 1000, time / 10000);
    const double t = time * i / 10;
    REQUIRE(bond.intensity() == 1);
    CHECK(bond.traction() == Approx(stiffness * speed * t + 3e8 * relaxation * speed * -std::expm1(-t / relaxation)).epsilon(1e-3));
  }
}

TEST_CASE("viscoelastic: held open, the traction decays to that of the spring as exp(-t / tau)", "[bonds]") {
  const auto law = viscoelastic(3e8, ", tangential_strength: 2e4");
  for (const double angle : {0.0, 0.9, 1.57}) {
    const double l = 1.3 * onset, d = l * std::cos(angle), u = l * std::sin(angle) / 2;  // K_T = 4 K
    PulledBond bond(*law);
    bond.pull(d, u, 1, 1e-9);
    const double damage = 1 - bond.intensity(), spring = (1 - damage) * stiffness * l, branch = (1 - damage) * 3e8 * l;
    CHECK(damage > 0);
    const auto traction = [&] { return std::hypot(bond.traction(), bond.across() / 2); };  // along the effective opening
    CHECK(traction() == Approx(spring + branch).epsilon(1e-6));
    const double h = relaxation / 2000;
    for (int i = 1; i <= 8000; ++i) {
      bond.step(d, u, h);
      if (i % 1000 == 0) CHECK(traction() == Approx(spring + branch * std::exp(-i * h / relaxation)).epsilon(1e-3));
    }
    CHECK(1 - bond.intensity() == damage);
  }
}

TEST_CASE("viscoelastic: a bond that unloads below its flow is slack in its branch, and heals nothing", "[bonds]") {
  const auto law = viscoelastic(3e8);
  PulledBond bond(*law);
  bond.pull(0.5 * onset, 0, 10, 1e-3);
  for (int i = 0; i < 100; ++i) bond.step(0.5 * onset, 0, relaxation);
  CHECK(bond.step(0.2 * onset, 0, 1e-3).by_d == Approx(stiffness * 0.2 * onset));  // v_d = 0.5 onset
  CHECK(bond.change().dissipated == Approx(0).margin(1e-12));
  CHECK(bond.intensity() == 1);
  CHECK(bond.step(0.6 * onset, 0, 1e-9).by_d == Approx((0.6 * stiffness + 0.1 * 3e8) * onset).epsilon(1e-6));
}

TEST_CASE("viscoelastic: the temperature moves the response along the logarithm of the speed", "[bonds]") {
  const double speed = last / relaxation;
  const auto response = [](BondLaw& law, double kelvin, double at_speed) {
    SiteState site;
    site.temperature = kelvin;
    law.assume_site(site);
    const PulledBond bond = pulled(law, at_speed, 4000);
    return std::pair(bond.peak(), bond.work());
  };
  const auto arrhenius = viscoelastic(3e8, ", shift: arrhenius, activation_energy: 60 kJ/mol, reference_temperature: 293 K");
  const auto wlf = viscoelastic(3e8, ", shift: wlf, reference_temperature: 293 K, wlf_c1: 8.86, wlf_c2: 101.6 K");
  for (const double kelvin : {253.0, 293.0, 333.0}) {
    const double by_arrhenius = std::exp(60e3 / 8.31446261815324 * (1 / kelvin - 1 / 293.0));
    const double by_wlf = std::pow(10, -8.86 * (kelvin - 293) / (101.6 + kelvin - 293));
    for (const double v : {0.1 * speed, speed, 10 * speed}) {
      for (const auto& [law, shift] : {std::pair(arrhenius.get(), by_arrhenius), std::pair(wlf.get(), by_wlf)}) {
        const auto shifted = response(*law, kelvin, v / shift), reference = response(*law, 293, v);
        CHECK(shifted.first == Approx(reference.first).epsilon(1e-9));
        CHECK(shifted.second == Approx(reference.second).epsilon(1e-9));
      }
    }
  }
  // Frozen below T_ref - C_2: the spring K + K_1 at any speed that is not infinitely slow.
  CHECK(response(*wlf, 293 - 110, 1e-3 * speed).first == Approx(2 * strength).epsilon(1e-3));
}

TEST_CASE("viscoelastic refuses contradictory parameters", "[bonds]") {
  CHECK_THROWS_WITH(viscoelastic(1e8, ", onset: 1e-5"), Catch::Contains("follows from onset"));
  CHECK_THROWS_WITH(bond_law("{type: viscoelastic, peak_traction: 1e4, work_of_adhesion: 1, relaxation_time: 1, onset: 1}"), Catch::Contains("before the traction is largest"));
  CHECK_THROWS_WITH(bond_law("{type: viscoelastic, peak_traction: 1e4, work_of_adhesion: 1, relaxation_time: 0}"), Catch::Contains("relaxation_time"));
  CHECK_THROWS_WITH(viscoelastic(1e8, ", shift: arrhenius"), Catch::Contains("activation_energy"));
  CHECK_THROWS_WITH(viscoelastic(1e8, ", activation_energy: 60 kJ/mol"), Catch::Contains("shift: arrhenius"));
  CHECK_THROWS_WITH(viscoelastic(1e8, ", shift: arrhenius, activation_energy: 60 kJ"), Catch::Contains("energy per amount (J/mol)"));
}
