// Steps that resolve how a body lets go: time.resolve_debonding.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>

#include "framework/stepping/debonding_check.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// Force between two objects and the gap between them, along the direction of the gap.
constexpr const char* probes =
    "probes:\n"
    "  - {name: force, type: contact_force, on: body, from: plate, direction: [0, 1, 0]}\n"
    "  - {name: gap, type: separation, direction: [0, 1, 0], from: {object: body, select: {type: face, direction: [0, 1, 0]}},\n"
    "     to: {object: plate, select: {type: face, direction: [0, -1, 0]}}}\n";

std::string time_of(const std::string& integrator, double h, bool resolves) {
  return fmt::format("gravity: [0, 0, 0]\ntime: {{step: {}, duration: 10, integrator: {}, resolve_debonding: {}}}\n", h, integrator, resolves);
}

constexpr double bond_work = 0.5e-4;  // J, of all bonds of the cube
constexpr double bond_mass = 1e-3;    // kg

// A rigid cube of 1 cm that bonds join to a plate, and whose load grows to twice their strength from `start` on. Its velocity: away from the plate.
std::string bonded(const std::string& time, double velocity, double load, double start) {
  return time + fmt::format(
      "solver: {{type: projected_newton, tolerance: 1e-6}}\n"
      "contact: {{distance: 0.5 mm, pairs: [{{between: [body, plate], bond_distance: 0.7 mm,\n"
      "  adhesion: {{type: bilinear, peak_traction: 10 kPa, work_of_adhesion: 0.5 J/m^2}}}}]}}\n"
      "objects:\n"
      "  - {{name: plate, shape: {{type: box, size: [0.02, 0.01, 0.02]}}, place: {{translate: [0, 0.005, 0]}}, motion: [fixed]}}\n"
      "  - {{name: body, shape: {{type: box, size: [0.01, 0.01, 0.01]}}, place: {{translate: [0, -0.0056, 0]}}, velocity: [0, {}, 0],\n"
      "     body: {{type: affine, density: 1000, stiffness: 1 GPa}},\n"
      "     loads: [{{type: traction, value: [0, {}, 0], ramp: [[0, 0], [{}, 0], [{}, 1]], select: {{type: face, direction: [0, -1, 0]}}}}]}}\n",
      -velocity, -load, start, start + 0.02) + probes;
}

// A soft block of 2 cm that adheres to a plate by a law of the gap, and is pulled off it by its lower face from `start` on.
std::string soft(const std::string& time, double start) {
  return time + fmt::format(
      "solver: {{type: projected_newton, tolerance: 0.1 mm/s}}\n"
      "contact: {{distance: 20 um, pairs: [{{between: [body, plate], adhesion: {{type: fang, peak_traction: 10 kPa, peak_distance: 20 um, range: 60 um}}}}]}}\n"
      "objects:\n"
      "  - {{name: plate, shape: {{type: box, size: [0.04, 0.01, 0.04]}}, place: {{translate: [0, 0.005, 0]}}, motion: [fixed]}}\n"
      "  - {{name: body, shape: {{type: box, size: [0.02, 0.02, 0.02], cells: [3, 3, 3]}}, place: {{translate: [0, -0.010012, 0]}},\n"
      "     energies: [{{type: neo_hookean, young: 0.1 MPa, poisson: 0, density: 1000}}],\n"
      "     motion: [{{type: formula, y: \"-0.01 * max(0, t - {})\", select: {{type: face, direction: [0, -1, 0]}}}}]}}\n", start) + probes;
}

struct Separation {
  double work = 0;      // J, of the force between both over the gap: trapezoidal rule
  double numerics = 0;  // J
  int steps = 0, rejected = 0;
};

// Runs until the gap exceeds `apart` [m].
Separation separate(const std::string& scene, double apart) {
  TestRun run(scene);
  Separation result;
  const auto sample = [&] { return std::array{run.sample(0).front(), run.sample(1).front()}; };
  for (auto [force, gap] = sample(); gap < apart; ++result.steps) {
    REQUIRE(result.steps < 5000);
    const StepReport report = run.step();
    result.rejected += report.rejections[Rejection::debonding];
    result.numerics += report.flows.numerics;
    const auto [now, end] = sample();
    result.work += (force + now) / 2 * (end - gap);
    force = now, gap = end;
  }
  return result;
}

}  // namespace

TEST_CASE("a body that is pulled off its bonds gives them their work, whatever the steps and the time of the load", "[step_size]") {
  for (const std::string integrator : {"implicit_euler", "newmark"})
    for (const double h : {2e-3, 1e-3, 5e-4, 2.5e-4})
      for (const double shift : {0.01, 0.26, 0.51, 0.76}) {
        INFO(integrator << ", steps of " << h << " s, load from " << shift << " steps on");
        const Separation resolved = separate(bonded(time_of(integrator, h, true), 0, 2e4, shift * h), 1e-3);
        if (h > 2.5e-4) CHECK(resolved.rejected > 0);
        CHECK(resolved.work == Approx(bond_work).epsilon(0.05));
      }
  // Without the check the work depends on the step.
  CHECK(separate(bonded(time_of("implicit_euler", 1e-3, false), 0, 2e4, 1e-5), 1e-3).work > 5 * bond_work);
}

TEST_CASE("a body that flies off its bonds loses their work of its kinetic energy", "[step_size]") {
  const auto lost = [](const std::string& integrator, double h, double speed, bool resolves) {
    TestRun run(bonded(time_of(integrator, h, resolves), speed, 0, 1e-6));
    for (int i = 0; run.state().time < 2e-3 || (run.sample(1).front() < 1e-3 && i < 500); ++i) run.step();
    double kinetic = 0;
    for (const int v : run.world->vertices_of(1)) kinetic += run.world->mass(v) / 2 * vertex(run.state().v, v).squaredNorm();
    return (bond_mass / 2 * speed * speed - kinetic) / bond_work;
  };
  for (const std::string integrator : {"implicit_euler", "newmark"})
    for (const double h : {2e-3, 1e-3, 5e-4, 2.5e-4})
      for (const double speed : {0.35, 0.5, 1.0}) {  // 1.2, 2.5 and 10 times the work of the bonds
        INFO(integrator << ", steps of " << h << " s, " << speed << " m/s");
        CHECK(lost(integrator, h, speed, true) == Approx(1).epsilon(0.12));
      }
  // Without the check it is stopped, or flies as if there were no bonds.
  CHECK(lost("implicit_euler", 1e-3, 0.5, false) == Approx(2.5).epsilon(0.01));
  CHECK(std::abs(lost("implicit_euler", 2.5e-4, 0.5, false)) < 0.01);
}

TEST_CASE("a soft block lets go of an adhesive plate for the work of adhesion, whatever the steps", "[step_size]") {
  // Returns what the time integration gains or loses until the block is off, over the work of adhesion.
  const auto error = [](double h, double shift, bool resolves) {
    const std::string scene = soft(time_of("newmark, energy_repeats: never", h, resolves), shift * h);
    const double work = 4e-4 * TestRun(scene).world->adhesion.front().effective;  // J
    return std::abs(separate(scene, 3e-4).numerics) / work;
  };
  for (const auto& [h, shift] : {std::pair{4e-3, 0.1}, {4e-3, 0.6}, {1e-3, 0.6}}) {
    INFO("steps of " << h << " s, pulled from " << shift << " steps on");
    CHECK(error(h, shift, true) < 0.1);
  }
  CHECK(error(4e-3, 0.1, false) > 0.3);
}

TEST_CASE("steps are the same with the check where nothing debonds, and without adhesion", "[step_size]") {
  const auto end = [](bool resolves, bool adheres) {
    TestRun run(time_of("implicit_euler", 1e-3, resolves) +
                "objects:\n"
                "  - {name: plate, shape: {type: box, size: [0.04, 0.01, 0.04]}, place: {translate: [0, -0.005, 0]}, motion: [fixed]}\n"
                "  - {name: body, shape: {type: box, size: [0.02, 0.02, 0.02], cells: [2, 2, 2]}, place: {translate: [0, 0.0103, 0]}, velocity: [0.1, -0.3, 0],\n"
                "     energies: [{type: neo_hookean, young: 1e5}]}\n"
                "contact: {distance: 0.5 mm, friction: {mu: 0.3}" +
                std::string(adheres ? ", pairs: [{between: [body, plate], adhesion: {type: fang, peak_traction: 1 MPa}}]" : "") + "}\n");
    for (int i = 0; i < 30; ++i) CHECK(run.step().rejections[Rejection::debonding] == 0);
    return run.state().x;
  };
  for (const bool adheres : {false, true}) CHECK(end(true, adheres) == end(false, adheres));
}

TEST_CASE("quasi-static steps refuse to resolve debonding", "[step_size]") {
  CHECK_THROWS_WITH(TestRun(bonded(time_of("quasi_static", 1e-3, true), 0, 1, 1e-6)), Catch::Contains("resolve_debonding") && Catch::Contains("has no inertia"));
}
