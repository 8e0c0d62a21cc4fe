// Delamination of two beams that bonds hold together, against beam theory: where shear acts across a lever, and where bonds are pressed.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// Two strips of length 2 L, thickness t, width B, with a crack of length a at the left end.
struct Beams {
  int cells = 80;
  double steps = 40;
  std::string side = "automatic";
  double young = 1e9, thickness = 1e-3, width = 2e-3, half = 0.04, crack = 0.03, work = 10, strength = 5e5, gap = 6e-5, most = 4e-3;

  std::string strip(const std::string& name, double y, const std::string& motions) const {
    return fmt::format("  - name: {}\n    shape: {{type: grid, size: [{}, {}], cells: [{}, 1]}}\n    place: {{translate: [{}, {}, 0]}}\n"
                       "    shell: {{thickness: {}}}\n    contact_offset: {}\n"
                       "    energies: [{{type: stvk_membrane, young: {}, poisson: 0}}, {{type: hinge_bending, young: {}, poisson: 0}}]\n    motion:\n{}",
                       name, 2 * half, width, cells, half, y, thickness, thickness / 2 - gap / 2, young, young, motions);
  }
  // End-notched flexure: on two supports, pushed down in the middle.
  std::string end_notched_flexure() const {
    const std::string middle = fmt::format("select: {{type: formula, where: abs(x - {}) < {}}}", half, half / cells / 2);
    return "objects:\n" +
           strip("lo", -thickness / 2,
                 "      - {type: fixed, along: [0, 1, 0], select: {type: face, direction: [-1, 0, 0]}}\n"
                 "      - {type: fixed, along: [0, 1, 0], select: {type: face, direction: [1, 0, 0]}}\n"
                 "      - {type: fixed, along: [1, 0, 0], select: {type: face, direction: [1, 0, 0]}}\n      - {type: fixed, along: [0, 0, 1]}\n") +
           strip("up", thickness / 2,
                 fmt::format("      - {{type: formula, y: \"-{}*t\", along: [0, 1, 0], {}}}\n      - {{type: fixed, along: [0, 0, 1]}}\n", most, middle)) +
           fmt::format("time: {{step: {}, duration: 1, integrator: quasi_static}}\n"
                       "contact:\n  distance: {}\n  barrier: {{type: clamped_log, stiffness: 1 MPa}}\n  pairs:\n"
                       "    - between: [{{object: up, select: {{type: formula, where: x > {}}}}}, {{object: lo, select: {{type: formula, where: x > {}}}}}]\n"
                       "      integrate: {}\n      bond_distance: {}\n"
                       "      adhesion: {{type: bilinear, peak_traction: {}, work_of_adhesion: {}, tangential_strength: {}, mixed_mode: benzeggagh_kenane, tangential_work: {}}}\n"
                       "    - {{between: [up, up], contact: false}}\n    - {{between: [lo, lo], contact: false}}\n"
                       "probes:\n  - {{name: load, type: reaction, object: up, {}, direction: [0, -1, 0]}}\n",
                       1 / steps, gap * 5 / 6, crack - 1e-6, crack - 1e-6, side, gap * 1.3, strength, work / 2, strength, work, middle);
  }
  // The energy that the crack releases as it grows, from the load and its way alone: the length is what beam theory makes of the two.
  double released(double load, double way) const {
    const double stiffness = 8 * young * width * std::pow(thickness, 3);
    const double length = std::cbrt((stiffness * way / load - 2 * std::pow(half, 3)) / 3);
    return 9 * load * load * length * length / (2 * stiffness * width);
  }
};

// On average while the crack grows: cell by cell the load goes in saw teeth.
double released_at_the_end(const Beams& beams) {
  TestRun run(beams.end_notched_flexure());
  double sum = 0;
  int count = 0;
  while (run.state().time < 1 - 1e-9) {
    run.step();
    if (run.state().time > 0.93) sum += beams.released(run.sample(0)[0], beams.most * run.state().time), ++count;
  }
  return sum / count;
}

}  // namespace

TEST_CASE("end-notched flexure: a crack sheared open releases its work, whichever side integrates", "[bonds]") {
  Beams lower{.side = "lo"}, upper{.side = "up"};
  const double of_lower = released_at_the_end(lower), of_upper = released_at_the_end(upper);
  CHECK(of_lower == Approx(lower.work).epsilon(0.03));
  CHECK(of_upper == Approx(lower.work).epsilon(0.03));
  CHECK(of_upper == Approx(of_lower).epsilon(2e-3));
}

TEST_CASE("end-notched flexure on finer strips", "[bonds][nightly]") {
  for (const std::string side : {"lo", "up", "automatic"}) CHECK(released_at_the_end({.cells = 160, .steps = 80, .side = side, .strength = 1e6}) == Approx(10).epsilon(0.03));
}

// Before the crack grows the arm is a beam on springs, which hold it down behind the root as stiffly as they hold it there:
// opening / load = a^3 / (3 E I) (1 + 3/m + 3/m^2 + 3/(2 m^3)), m = a (k / (4 E I))^(1/4), k = K b.
TEST_CASE("double cantilever: the root of the crack is as stiff as a beam on springs", "[bonds]") {
  const double young = 135.3e9, width = 5e-3, thickness = 1.5e-3, crack = 30e-3, strength = 57e6, onset = 0.5e-6, way = 4e-5;
  TestRun run("objects:\n"
              "  - {name: middle, shape: {type: grid, size: [0.03, 0.006]}, place: {translate: [0.015, 0, 0]}, motion: [fixed]}\n"
              "  - name: arm\n    shape: {type: grid, size: [0.06, 0.005], cells: [240, 2]}\n    place: {translate: [0, 20e-6, 0]}\n"
              "    shell: {thickness: 1.5e-3}\n"
              "    energies: [{type: stvk_membrane, young: 135.3e9, poisson: 0}, {type: hinge_bending, young: 135.3e9, poisson: 0}]\n    motion:\n"
              "      - {type: formula, y: 4e-5 * t, along: [0, 1, 0], select: {type: face, direction: [-1, 0, 0]}}\n"
              "      - {type: fixed, select: {type: face, direction: [1, 0, 0]}}\n      - {type: fixed, along: [0, 0, 1]}\n"
              "time: {step: 1, duration: 1, integrator: quasi_static}\n"
              "contact:\n  distance: 20e-6\n  pairs:\n"
              "    - {between: [arm, middle], bond_distance: 22e-6, adhesion: {type: bilinear, peak_traction: 57e6, work_of_adhesion: 140, onset: 0.5e-6}}\n"
              "    - {between: [arm, arm], contact: false}\n"
              "probes:\n  - {name: load, type: reaction, object: arm, select: {type: face, direction: [-1, 0, 0]}, direction: [0, 1, 0]}\n");
  while (run.state().time < 1 - 1e-9) run.step();
  const double bending = young * width * std::pow(thickness, 3) / 12, m = crack * std::pow(strength / onset * width / (4 * bending), 0.25);
  const double stiffness = 3 * bending / std::pow(crack, 3) / (1 + 3 / m + 3 / (m * m) + 1.5 / (m * m * m));
  CHECK(run.sample(0)[0] / way == Approx(stiffness).epsilon(0.03));
}
