// Probes of formulas of other probes.
#include <catch2/catch.hpp>

#include "framework/output/probe_set.hpp"
#include "geometry/errors.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

const std::string cube =
    "objects:\n  - {name: cube, shape: {type: box, size: [1, 1, 1]}, place: {translate: [2, 3, 4]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
    "probes:\n  - {name: c, type: centre_of_mass, object: cube}\n  - {name: kinetic energy, type: energy, term: kinetic}\n";

std::vector<double> sampled(const std::string& probes, double time = 0) {
  TestScene s(cube + probes);
  ProbeSet set = probes_of(s.built);
  State state = s.world->start;
  state.time = time;
  return set.sample(*s.world, state);
}

}  // namespace

TEST_CASE("a formula of other probes and the time", "[probes]") {
  const auto values = sampled("  - {name: sum, type: formula, of: c_x + c_y - 2 * c_z}\n  - {name: more, type: formula, of: 'sum * t', unit: m}\n", 0.5);
  REQUIRE(values.size() == 6);
  CHECK(values[4] == Approx(2 + 3 - 8));
  CHECK(values[5] == Approx(-1.5));
}

TEST_CASE("expectations use the unit of a formula", "[probes]") {
  const std::string probe = "  - {name: a, type: formula, of: c_x * c_y, unit: m^2}\n";
  CHECK_NOTHROW(sampled(probe + "expect: [{probe: a, statistic: final, at_least: 1 cm^2}]\n"));
  CHECK_THROWS_WITH(sampled(probe + "expect: [{probe: a, statistic: final, at_least: 1 kg}]\n"), Catch::Contains("at_least"));
  CHECK_THROWS_WITH(sampled("  - {name: a, type: formula, of: c_x, unit: mm2x}\n"), Catch::Contains("unit"));
}

TEST_CASE("a formula whose unit is not SI has a column in SI, and expectations in its unit hold", "[probes]") {
  const std::string probe = "  - {name: mN, type: formula, of: 1000 * 0.0908, unit: mN}\n  - {name: double, type: formula, of: 2 * mN, unit: N}\n";
  const auto passes = [&](const std::string& criterion) {
    TestScene s(cube + probe + "expect: [{probe: mN, statistic: max, " + criterion + "}]\n");
    ProbeSet set = probes_of(s.built);
    std::vector<double> row = set.sample(*s.world, s.world->start);
    row.insert(row.begin(), 0);
    std::vector<std::string> columns{"time"};
    columns.insert(columns.end(), set.columns().begin(), set.columns().end());
    return evaluate(s.config.expect[0], ProbeSeries{columns, {row}}).pass;
  };
  CHECK(sampled(probe)[4] == Approx(0.0908));
  CHECK(sampled(probe)[5] == Approx(0.1816));
  CHECK_FALSE(passes("at_least: 100 mN"));
  CHECK(passes("at_most: 100 mN"));
  CHECK(passes("at_least: 90 mN"));
  CHECK(passes("at_most: 0.1 N"));
  CHECK(passes("at_most: 0.1"));  // plain numbers are SI
  CHECK_FALSE(passes("at_least: 50"));
  CHECK(passes("target: 90.8 mN, within: 0.1 mN"));
  CHECK_THROWS_WITH(passes("at_least: 1 mm"), Catch::Contains("at_least"));
}

TEST_CASE("an unknown variable of a formula is reported with the known ones", "[probes]") {
  CHECK_THROWS_WITH(sampled("  - {name: a, type: formula, of: later + 1}\n  - {name: later, type: energy}\n"),
                    Catch::Contains("probe 'a'") && Catch::Contains("c_x, c_y, c_z"));
  CHECK_THROWS_WITH(sampled("  - {name: a, type: formula, of: c_x +}\n"), Catch::Contains("probe 'a'"));
}
