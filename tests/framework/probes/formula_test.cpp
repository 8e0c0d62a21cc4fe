// Probes of probes.
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

TEST_CASE("its unit holds for expectations", "[probes]") {
  const std::string probe = "  - {name: a, type: formula, of: c_x * c_y, unit: m^2}\n";
  CHECK_NOTHROW(sampled(probe + "expect: [{probe: a, statistic: final, at_least: 1 cm^2}]\n"));
  CHECK_THROWS_WITH(sampled(probe + "expect: [{probe: a, statistic: final, at_least: 1 kg}]\n"), Catch::Contains("at_least"));
  CHECK_THROWS_WITH(sampled("  - {name: a, type: formula, of: c_x, unit: mm2x}\n"), Catch::Contains("unit"));
}

TEST_CASE("what a formula cannot see is told with what it can", "[probes]") {
  CHECK_THROWS_WITH(sampled("  - {name: a, type: formula, of: later + 1}\n  - {name: later, type: energy}\n"),
                    Catch::Contains("probe 'a'") && Catch::Contains("c_x, c_y, c_z"));
  CHECK_THROWS_WITH(sampled("  - {name: a, type: formula, of: c_x +}\n"), Catch::Contains("probe 'a'"));
}
