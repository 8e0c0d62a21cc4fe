// Impacts with displacements per step of hundreds of times the thickness of the plate.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

TestRun impact(double speed, double angle) {
  return TestRun(fmt::format(
      "time: {{step: 0.01, duration: 0.01}}\nsolver: {{type: projected_newton, check_iterates: true}}\nobjects:\n"
      "  - {{name: plate, shape: {{type: box, size: [0.4, 0.004, 0.4], cells: [10, 1, 10]}},\n"
      "     place: {{translate: [0, -0.002, 0]}}, energies: [{{type: neo_hookean, young: 1e7, poisson: 0.3}}],\n"
      "     motion: [{{type: fixed, select: {{type: face, direction: [-1, 0, 0]}}}},\n"
      "              {{type: fixed, select: {{type: face, direction: [1, 0, 0]}}}}]}}\n"
      "  - {{name: ball, shape: {{type: sphere, radius: 0.05, cells: 4}},\n"
      "     place: {{axis: [0.3, 0.1, 1], angle: {}, translate: [0, 0.12, 0]}}, velocity: [0, -{}, 0],\n"
      "     energies: [{{type: neo_hookean, young: 1e6, poisson: 0.3}}]}}\n"
      "contact: {{distance: 1 mm}}\n", angle, speed));
}

}  // namespace

TEST_CASE("a ball hits a thin plate at 200 and 1000 m/s in steps of 10 ms", "[stepping]") {
  const double speed = GENERATE(200, 1000);
  INFO(speed << " m/s");
  // The iterations of a single impact at 1000 m/s, 130 to 400, depend on round-off.
  std::vector<int> iterations;
  for (const double angle : {0.25, 0.28, 0.31}) {
    TestRun run = impact(speed, angle);
    const StepReport report = run.step();
    CHECK(run.warnings.empty());  // in one whole step
    CHECK(report.min_distance > 1e-7);  // m; barrier of the area in contact
    iterations.push_back(report.solve.iterations);
  }
  std::sort(iterations.begin(), iterations.end());
  CHECK(iterations[1] < 250);
}
