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
  CHECK(bond.step(0.2 * onset, 0, 1e-3).by_d == Approx(stiffness * 0.2 * onset));
  CHECK(bond.change().dissipated == Approx(0).margin(1e-12));
  CHECK(bond.intensity() == 1);
  CHECK(bond.step(0.6 * onset, 0, 1e-9).by_d == Approx((0.6 * stiffness + 0.1 * 3e8) * onset).epsilon(1e-6));
}

TEST_CASE("viscoelastic refuses contradictory parameters", "[bonds]") {
  CHECK_THROWS_WITH(viscoelastic(1e8, ", onset: 1e-5"), Catch::Contains("follows from onset"));
  CHECK_THROWS_WITH(bond_law("{type: viscoelastic, peak_traction: 1e4, work_of_adhesion: 1, relaxation_time: 1, onset: 1}"), Catch::Contains("before the traction is largest"));
  CHECK_THROWS_WITH(bond_law("{type: viscoelastic, peak_traction: 1e4, work_of_adhesion: 1, relaxation_time: 0}"), Catch::Contains("relaxation_time"));
}
