// Rebound speed of a block that hits a floor at 1 m/s, with Newmark's rule and any step size.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "framework/world/energy_records.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

struct Rebound {
  double speed;         // of the centre of mass [m/s]
  double grown;         // largest increase of energy from any time to a later one, over that at the start
  int steps, refined;
};

Rebound rebound(double h, const std::string& pair = "") {
  TestRun run(fmt::format("time: {{step: {}, duration: 10, integrator: newmark}}\nsolver: {{type: projected_newton}}\nobjects:\n"
                          "  - {{name: floor, shape: {{type: box, size: [0.5, 0.02, 0.5]}}, place: {{translate: [0, -0.01, 0]}}, motion: [fixed]}}\n"
                          "  - {{name: block, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}}, place: {{translate: [0, 0.055, 0]}},\n"
                          "     velocity: [0, -1, 0], energies: [{{type: neo_hookean, young: 10 MPa}}]}}\ncontact:\n  distance: 1 mm\n{}", h, pair));
  Rebound r{};
  double lowest = 0.5;  // J
  while (run.state().time < 0.03 * (1 - 1e-9)) {
    const StepReport report = run.step();
    ++r.steps;
    r.refined += report.flows.refined;
    const double energy = stored_energy(report.energies);
    lowest = std::min(lowest, energy);
    r.grown = std::max(r.grown, (energy - lowest) / 0.5);
  }
  r.speed = run.world->centre_of_mass(1, run.state().v).y();
  return r;
}

}  // namespace

TEST_CASE("smaller steps conserve more of the rebound speed if they resolve contact, and gain no energy", "[stepping]") {
  double before = 0.75;
  for (const double h : {0.002, 0.001, 0.0005}) {
    const Rebound r = rebound(h);
    INFO("h " << h << " s: speed " << r.speed);
    CHECK(r.refined > 0);
    CHECK(r.speed > before);
    CHECK(r.grown <= 0.01);
    CHECK(r.steps <= 2 * 0.03 / h + 24);  // the flight after it is not refined
    before = r.speed;
  }
}

TEST_CASE("an impact that the smallest steps do not resolve is not refined", "[stepping]") {
  const Rebound r = rebound(0.01);
  INFO("speed " << r.speed);
  CHECK(r.steps == 3);
  CHECK(r.refined == 0);
}

TEST_CASE("an adhesive rebound that is refined gains no energy", "[stepping]") {
  for (const double h : {0.002, 0.001}) {
    INFO("h " << h << " s");
    const Rebound r = rebound(h, "  pairs: [{between: [block, floor], adhesion: {type: fang, peak_traction: 3 kPa}}]\n");
    CHECK(r.refined > 0);
    CHECK(r.grown <= 0.015);
  }
}
