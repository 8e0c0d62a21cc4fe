// Messages about limits of materials and joints that a prescribed motion exceeds.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "geometry/errors.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// Steps until the run fails. Returns the message.
std::string failure_of(TestRun& run) try {
  for (int i = 0; i < 100; ++i) run.step();
  return "";
} catch (const SimulationError& error) {
  return error.what();
}

// An object 60 mm long, one end of which moves away at 5 mm/s; nothing moves sideways.
std::string pulled(const std::string& shape, const std::string& energies) {
  return fmt::format("time: {{step: 50 ms, duration: 5 s, integrator: quasi_static}}\n"
                     "objects:\n"
                     "  - name: strip\n"
                     "    shape: {}\n"
                     "    energies: [{}]\n"
                     "    motion:\n"
                     "      - {{type: fixed, along: [1, 0, 0], select: {{type: face, direction: [-1, 0, 0]}}}}\n"
                     "      - {{type: fixed, along: [0, 0, 1]}}\n"
                     "      - {{type: fixed, along: [0, 1, 0]}}\n"
                     "      - {{type: formula, x: 0.005 * t, select: {{type: face, direction: [1, 0, 0]}}}}\n",
                     shape, energies);
}

constexpr const char* sheet = "{type: grid, size: [60 mm, 10 mm], cells: [6, 1]}\n    shell: {thickness: 0.3 mm}";
constexpr const char* box = "{type: box, size: [60 mm, 10 mm, 10 mm], cells: [6, 1, 1]}";

}  // namespace

TEST_CASE("a motion beyond a strain limit names triangle, strain, limit and remedy", "[shells]") {
  TestRun run(pulled(sheet, "{type: stvk_membrane, young: 0.2 MPa, poisson: 0, density: 500}, {type: strain_limit, strain: 10%, stiffness: 1 kPa}"));
  const std::string error = failure_of(run);
  CHECK(run.state().time == Approx(1.2).margin(0.01));  // 6 mm of 60 mm
  CHECK_THAT(error, Catch::Contains("triangle (") && Catch::Contains("of 'strip' would have the principal strain 0.1") &&
                        Catch::Contains("strain_limit allows less than 0.1 (`strain`)") && Catch::Contains("prescribe a smaller motion, or raise that limit"));
}

TEST_CASE("a motion beyond Gent's limit names element, I1, limit and remedy", "[hyperelastic]") {
  const bool solid = GENERATE(false, true);
  INFO((solid ? "solid" : "membrane"));
  TestRun run(solid ? pulled(box, "{type: gent, shear_modulus: 0.1 MPa, poisson: 0.49, j_m: 0.02}")
                    : pulled(sheet, "{type: gent_membrane, shear_modulus: 0.1 MPa, j_m: 0.02}"));
  const std::string error = failure_of(run);
  // I1 - 3 = 0.02: of the sheet s^2 + s^-2 - 2, of the solid, whose volume grows, s^(4/3) + 2 s^(-2/3) - 3.
  CHECK(run.state().x.maxCoeff() + 0.03 == Approx(0.06 * (solid ? 1.1284 : 1.0733)).epsilon(2e-3));
  CHECK_THAT(error, Catch::Contains(solid ? "tet (" : "triangle (") && Catch::Contains("of 'strip' would have I1 - 3 of 0.02") &&
                        Catch::Contains("allows less than 0.02 (`j_m`)") && Catch::Contains("prescribe a smaller motion, or raise that limit"));
}

TEST_CASE("a motion beyond the limit of a hinge names joint, angle, limit and remedy", "[joints]") {
  TestRun run("time: {step: 50 ms, duration: 5 s}\n"
              "objects:\n"
              "  - name: arm\n"
              "    shape: {type: box, size: [0.1, 0.02, 0.02]}\n"
              "    body: {type: affine, density: 1000}\n"
              "    motion: [{type: rotate, axis: [0, 0, 1], centre: [-0.05, 0, 0], angular_velocity: 0.5 rad/s, select: {type: face, direction: [1, 0, 0]}}]\n"
              "interactions:\n"
              "  - {name: pin, type: hinge, object: arm, at: [-0.05, 0, 0], axis: [0, 0, 1], limits: {low: -0.5 rad, high: 0.4 rad}}\n");
  const std::string error = failure_of(run);
  CHECK(run.state().time == Approx(0.8).margin(0.01));
  CHECK_THAT(error, Catch::Contains("joint 'pin' would have the angle 0.4") && Catch::Contains("allows less than 0.4 rad (`limits.high`)") &&
                        Catch::Contains("prescribe a smaller motion, or raise that limit"));
}
