// Free bodies of quasi-static steps.
#include "framework/stepping/free_bodies.hpp"

#include <catch2/catch.hpp>

#include "framework/run/equilibrium_check.hpp"
#include "framework/stepping/stepper.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A cube of 1 N above a floor at a gap, with a traction on its upper face.
std::string cube(const std::string& gap, const std::string& traction, const std::string& more = "") {
  return "time: {step: 0.25, duration: 1, integrator: quasi_static}\ngravity: [0, -9.81, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: box, size: [0.4, 0.02, 0.4]}, place: {translate: [0, -0.01, 0]}, motion: [fixed]}\n"
         "  - name: cube\n"
         "    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}\n"
         "    place: {translate: [0, " + gap + ", 0]}\n"
         "    energies: [{type: neo_hookean, young: 1e6, poisson: 0.3, density: 101.94}]\n"
         "    loads: [{type: traction, value: [0, " + traction + ", 0], ramp: [[0, 0], [1, 1]], select: {type: face, direction: [0, 1, 0]}}]\n" + more +
         "contact: {distance: 1 mm}\n";
}

std::string error_of(const std::string& yaml, double until) {
  TestRun s(yaml);
  try {
    while (s.state().time < until) s.step();
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a quasi-static body supported by contact alone comes to rest, also from a distance", "[stepping]") {
  CHECK(error_of(cube("0.0505", "50"), 0.99).empty());
  CHECK(error_of(cube("0.055", "50"), 0.99).empty());
}

TEST_CASE("a quasi-static body that a load lifts off is named, with a remedy", "[stepping]") {
  const std::string error = error_of(cube("0.0505", "250"), 0.99);
  INFO(error);
  CHECK(contains(error, "nothing supports 'cube' against the force ("));
  CHECK(contains(error, "fix it (motion, attach)"));
}

TEST_CASE("a quasi-static body that falls past all others is named in its first step", "[stepping]") {
  const std::string beside = "  - {name: other, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [1, 0.5, 0]}, energies: [{type: neo_hookean, young: 1e6}]}\n";
  const std::string error = error_of(cube("0.0505", "50", beside), 0.1);
  INFO(error);
  CHECK(contains(error, "nothing supports 'other'"));
}

TEST_CASE("a quasi-static body fixed in some directions is free in the others", "[stepping]") {
  const auto cube_fixed = [](const char* directions) {
    return std::string("time: {step: 0.25, duration: 1, integrator: quasi_static}\ngravity: [0, -9.81, 0]\n"
                       "objects:\n"
                       "  - name: cube\n    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}\n"
                       "    energies: [{type: neo_hookean, young: 1e6, poisson: 0.3, density: 101.94}]\n"
                       "    motion: [{type: fixed") + directions + ", select: {type: face, direction: [0, -1, 0]}}]\n";
  };
  const std::string slides = error_of(cube_fixed(", along: [1, 0, 0]"), 0.99);
  INFO(slides);
  CHECK(contains(slides, "nothing supports 'cube' against the force (0, -1, 0) N"));
  CHECK(error_of(cube_fixed(""), 0.99).empty());
  CHECK(error_of(cube_fixed(", along: [0, 1, 0]"), 0.99).empty());
}

// The check of `tack check`.
TEST_CASE("a body without equilibrium is found before the run", "[checks]") {
  const auto check = [](const std::string& yaml) {
    TestRun s(yaml);
    return check_equilibrium(s.config, *s.world, s.clock);
  };
  const std::string beside = "  - {name: other, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [1, 0.5, 0]}, energies: [{type: neo_hookean, young: 1e6}]}\n";
  CHECK(check(cube("0.0505", "50")).error.empty());
  const EquilibriumCheck falls = check(cube("0.0505", "50", beside));
  INFO(falls.error);
  CHECK(contains(falls.error, "nothing supports 'other'"));
  CHECK(contains(falls.error, "fix it (motion, attach)"));
  // With inertia it falls without an error.
  std::string dynamic = cube("0.0505", "50", beside);
  dynamic.replace(dynamic.find("quasi_static"), 12, "implicit_euler");
  CHECK(check(dynamic).error.empty());
}

TEST_CASE("a torque on an unsupported body is reported before the run", "[checks]") {
  const auto warnings_of = [](const char* upper, const char* lower, const char* motion = "") {
    TestRun s(std::string("time: {step: 0.25, duration: 1, integrator: quasi_static}\n"
                          "objects:\n"
                          "  - name: held\n    shape: {type: box, size: [0.1, 0.1, 0.1]}\n    place: {translate: [1, 0, 0]}\n    energies: [{type: neo_hookean, young: 1e6}]\n    motion: [fixed]\n"
                          "  - name: cube\n    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}\n    energies: [{type: neo_hookean, young: 1e6}]\n") + motion +
              "    loads:\n      - {type: traction, value: [" + upper + ", 0, 0], select: {type: face, direction: [0, 1, 0]}}\n"
              "      - {type: traction, value: [" + lower + ", 0, 0], select: {type: face, direction: [0, -1, 0]}}\n");
    const EquilibriumCheck check = check_equilibrium(s.config, *s.world, s.clock);
    CHECK(check.error.empty());
    return check.warnings;
  };
  const std::string turns = only_text(warnings_of("50", "-50"), WarningKind::free_rotation);
  INFO(turns);
  CHECK(contains(turns, "nothing prevents 'cube' from rotating under the torque (0, 0, -0.05) N m"));
  CHECK(contains(turns, "fix it (motion, attach)"));
  CHECK(warnings_of("0", "0").empty());
  CHECK(warnings_of("50", "-50", "    motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]\n").empty());
}
