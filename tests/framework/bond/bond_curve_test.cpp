// Bonds on prescribed paths.
#include "framework/bond/bond_curve.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/bond_laws.hpp"

using namespace tack;

TEST_CASE("a bond that is pulled to and fro reverses at the turning points, in equal steps", "[bond_curve]") {
  const auto law = bond_law("{type: bilinear, peak_traction: 1e4, work_of_adhesion: 1}");
  const std::vector<BondPoint> points = pull_bond(*law, {5e-5, 0, 1e-4}, std::numbers::pi / 2, 200);
  REQUIRE(points.size() == 200);
  CHECK(points[49].slip == Approx(5e-5));
  CHECK(points[99].slip == 0);
  CHECK(points.back().slip == Approx(1e-4));
  for (const BondPoint& p : points) CHECK(p.opening == 0);  // across is across
  for (int i = 50; i < 100; ++i) CHECK(points[i].intensity == points[49].intensity);
  // The envelope falls from 1e4 Pa at 2e-5 m to 0 at 2e-4 m: the area below it so far, without the triangle that is stored.
  CHECK(points.back().shear == Approx(1e5 / 18));
  CHECK(points.back().stored == Approx(1e5 / 18 * 1e-4 / 2));
  CHECK(points.back().dissipated == Approx(0.1 + (1e4 + 1e5 / 18) / 2 * 8e-5 - 1e5 / 18 * 1e-4 / 2));
}

TEST_CASE("at a constant speed, the time of a path is its length over the speed", "[bond_curve]") {
  const auto law = bond_law("{type: rcc, normal_stiffness: 1e8, work_of_adhesion: 1, viscosity: 0.01}");
  const auto fast = pull_bond(*law, {2e-4, 1e-4}, 0, 300, 1e-3), slow = pull_bond(*law, {2e-4, 1e-4}, 0, 300);
  CHECK(fast.back().time == Approx(0.3));
  CHECK(fast[199].intensity > slow[199].intensity);
  CHECK(slow[199].intensity == Approx(0.25).epsilon(1e-6));  // W / k
}

TEST_CASE("explicitly integrated laws get steps that are stable", "[bond_curve]") {
  for (const char* eta : {"1e-6", "0.01", "1e3"}) {
    INFO(eta);
    const auto law = bond_law(std::string("{type: rcc_explicit, normal_stiffness: 1e8, work_of_adhesion: 1, viscosity: ") + eta + "}");
    CHECK(law->longest_step() == Approx(std::stod(eta)));
    double peak = 0;
    for (const BondPoint& p : separate_slowly(*law)) peak = std::max(peak, p.traction);
    CHECK(peak == Approx(1e4).epsilon(0.01));
    CHECK(pull_bond(*law, {2e-4}, 0, 400).back().intensity == Approx(0.25).epsilon(0.02));
  }
}

TEST_CASE("a bond is separated until it fails, at any scale; bonds that never fail have no curve", "[bond_curve]") {
  for (const char* yaml : {"{type: rcc, normal_stiffness: 1e14, work_of_adhesion: 1e-6}", "{type: rcc, normal_stiffness: 1, work_of_adhesion: 1e6}",
                           "{type: bonded, peak_traction: 1e6}", "{type: exponential, peak_traction: 10, work_of_adhesion: 1e-9}"}) {
    INFO(yaml);
    const auto law = bond_law(yaml);
    const auto parted = separate_slowly(*law);
    REQUIRE(!parted.empty());
    double peak = 0;
    for (const BondPoint& p : parted) peak = std::max(peak, p.traction);
    CHECK(peak == Approx(law->peak_traction()).epsilon(0.01));
    CHECK(parted.back().traction <= 1e-3 * peak);
    CHECK(parted.back().dissipated == Approx(law->work_of_adhesion()).epsilon(0.01));
  }
  CHECK(separate_slowly(*bond_law("{type: rcc, normal_stiffness: 1e8, work_of_adhesion: 1}"), std::numbers::pi / 2).empty());
  CHECK(separate_slowly(*bond_law("{type: rcc, normal_stiffness: 1e8, work_of_adhesion: 0}")).empty());
}
