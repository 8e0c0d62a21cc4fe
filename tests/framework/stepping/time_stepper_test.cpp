#include "framework/stepping/time_stepper.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "geometry/errors.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A soft bar fixed at one end while the other flies off: hard for one Newton iteration.
std::string hard_scene(double tolerance, int max_halvings) {
  return fmt::format("time: {{step: 0.02, duration: 0.06, max_cutbacks: {}}}\n"
                     "solver: {{type: projected_newton, tolerance: {}, max_iterations: 1}}\n"
                     "objects: [{{name: bar, shape: {{type: box, size: [0.4, 0.1, 0.1], cells: [4, 1, 1]}},\n"
                     "  velocity: [6, 8, 0], energies: [{{type: neo_hookean, young: 1e5}}],\n"
                     "  motion: [{{type: fixed, select: {{type: face, direction: [-1, 0, 0]}}}}]}}]\n",
                     max_halvings, tolerance);
}

std::string bar(const std::string& material, double poisson, double traction) {
  return fmt::format("time: {{step: 1, duration: 1, integrator: quasi_static}}\n"
                     "solver: {{type: projected_newton, force_tolerance: 1e-10}}\n"
                     "objects: [{{name: bar, shape: {{type: box, size: [0.5, 0.1, 0.1], cells: [5, 2, 2]}},\n"
                     "  energies: [{{type: {}, young: 1e5, poisson: {}}}],\n"
                     "  motion: [{{type: fixed, select: {{type: face, direction: [-1, 0, 0]}}}}],\n"
                     "  loads: [{{type: traction, value: [{}, 0, 0], select: {{type: face, direction: [1, 0, 0]}}}}]}}]\n",
                     material, poisson, traction);
}

// Returns the stretch at each vertex of the loaded end.
double stretch(const std::string& yaml) {
  TestScene scene(yaml);
  TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
  const StepReport report = stepper.advance();
  CHECK(report.converged);
  CHECK(stepper.finished());
  CHECK(stepper.state().v.isZero());
  double longest = 0, shortest = 1e9;
  for (int v = 0; v < scene.world->rest.size() / 3; ++v) {
    if (vertex(scene.world->rest, v).x() < 0.2499) continue;
    const double length = vertex(stepper.state().x, v).x() + 0.25;
    longest = std::max(longest, length);
    shortest = std::min(shortest, length);
  }
  CHECK(longest - shortest < 1e-8);
  return longest / 0.5;
}

}  // namespace

TEST_CASE("a failed solve is rolled back and cut back, with warnings", "[stepping]") {
  TestScene scene(hard_scene(0.5, 12));
  std::vector<Warning> warnings;
  TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock,
                      [&](const Warning& w) { warnings.push_back(w); });
  int halvings = 0, steps = 0, ends = 0;
  while (!stepper.finished() && steps < 10000) {
    const double before = stepper.state().time;
    const StepReport report = stepper.advance();
    ++steps;
    halvings += report.rejections.cutbacks();
    CHECK(report.converged);
    CHECK(report.solve.iterations == 1);
    CHECK(report.step_size <= 0.02);
    CHECK(stepper.state().time == Approx(before + report.step_size).epsilon(1e-12));
    ends += std::abs(std::remainder(stepper.state().time, 0.02)) < 1e-12;
  }
  CHECK(halvings > 0);
  CHECK(warnings.size() == static_cast<size_t>(halvings));
  CHECK_THAT(first_text(warnings, WarningKind::step_cutback), Catch::Contains("iteration limit"));
  CHECK(ends == 3);  // the end of every whole step is met
  CHECK(stepper.state().time == Approx(0.06).epsilon(1e-12));
  CHECK(steps == stepper.state().step);
}

TEST_CASE("when no step is small enough the run ends, with the last state intact", "[stepping]") {
  for (const int max_halvings : {0, 3}) {
    TestScene scene(hard_scene(1e-14, max_halvings));
    int warnings = 0;
    TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [&](const Warning&) { ++warnings; });
    CHECK_THROWS_AS(stepper.advance(), SimulationError);
    CHECK(warnings == max_halvings);
    CHECK(stepper.state().time == 0);
    CHECK(stepper.state().step == 0);
    CHECK((stepper.state().x == scene.world->start.x));
    CHECK((stepper.state().v == scene.world->start.v));
  }
}

TEST_CASE("a quasi-static bar under traction stretches by its modulus", "[stepping]") {
  for (const double traction : {100.0, 2e4, 8e4, -400.0}) {  // more compression would buckle it
    INFO("traction " << traction << " Pa");
    const double mu = 1e5 / 2, s = traction / mu;  // nu = 0: no lateral contraction
    CHECK(stretch(bar("neo_hookean", 0, traction)) ==
          Approx((s + std::sqrt(s * s + 4)) / 2).epsilon(1e-8));  // mu (a - 1/a) = traction
    CHECK(stretch(bar("fixed_corotated", 0, traction)) == Approx(1 + traction / 1e5).epsilon(1e-8));
  }
}

TEST_CASE("fixed vertices stay; energies are reported", "[stepping]") {
  TestScene scene("gravity: [0, -9.81, 0]\ntime: {step: 0.01, duration: 0.05}\n"
                  "objects: [{name: bar, shape: {type: box, size: [0.4, 0.1, 0.1], cells: [4, 1, 1]},\n"
                  "  energies: [{type: neo_hookean, young: 1e5}],\n"
                  "  motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}]}]\n");
  TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
  StepReport report;
  while (!stepper.finished()) report = stepper.advance();
  CHECK(report.step == 5);
  int fixed_count = 0;
  for (int v = 0; v < scene.world->rest.size() / 3; ++v) {
    if (scene.world->dofs.block(v) >= 0) continue;
    ++fixed_count;
    CHECK((vertex(stepper.state().x, v) == vertex(scene.world->rest, v)));
    CHECK(vertex(stepper.state().v, v).isZero());
  }
  CHECK(fixed_count == 4);
  std::map<std::string, double> energies;
  for (const NamedEnergy& energy : report.energies) energies[energy.name] = energy.value;
  CHECK(energies.at("kinetic") > 0);
  CHECK(energies.at("neo_hookean") > 0);
  CHECK(energies.at("gravity") < 0);  // falls
  // implicit Euler loses energy and gains none
  CHECK(energies.at("kinetic") + energies.at("neo_hookean") + energies.at("gravity") <= 1e-9);
}

TEST_CASE("time.energy_repeats decides which integrators repeat steps for their energy", "[stepping]") {
  // A box that spins about a fixed point, too fast for the step.
  const auto repeats = [](const std::string& integrator, const std::string& option) {
    TestScene scene(fmt::format("time: {{step: 2 ms, duration: 40 ms, integrator: {}{}}}\nsolver: {{type: projected_newton}}\ngravity: [0, -9.81, 0]\nobjects:\n"
                                "  - {{name: top, shape: {{type: box, size: [0.1, 0.06, 0.1], cells: [2, 2, 2]}}, body: {{type: affine, density: 2000}},\n"
                                "     place: {{axis: [0, 0, 1], angle: 20 deg, translate: [-0.01026, 0.02819, 0]}}, spin: [-34.2, 93.97, 0],\n"
                                "     motion: [{{type: fixed, select: {{type: sphere, centre: [0, 0, 0], radius: 1 mm}}}}]}}\n",
                                integrator, option.empty() ? "" : ", energy_repeats: " + option));
    TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
    int count = 0;
    while (!stepper.finished()) {
      const StepReport report = stepper.advance();
      count += report.rejections.of_energy();
      CHECK(report.step_size >= 2e-3 / 8 * (1 - 1e-9));
      CHECK(report.flows.refined == (report.step_size < 2e-3 * (1 - 1e-9)));
    }
    return count;
  };
  CHECK(repeats("newmark", "") > 0);
  CHECK(repeats("newmark", "always") == repeats("newmark", "auto"));
  CHECK(repeats("newmark", "never") == 0);
  CHECK(repeats("implicit_euler", "") == 0);
  CHECK(repeats("implicit_euler", "always") > 0);
}
