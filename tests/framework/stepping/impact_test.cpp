// Impacts and lasting contact under each integrator: energy, momentum, order.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/world/energy_records.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

std::string header(const std::string& integrator, double h) {
  return fmt::format("time: {{step: {}, duration: 10, integrator: {}}}\n"
                     "solver: {{type: projected_newton, linear: cholmod, tolerance: 1 mm/s}}\n", h, integrator);
}

// A block of 1 kg flies at a floor.
std::string block_on_floor(const std::string& velocity, const std::string& contact, const std::string& young) {
  return "objects:\n"
         "  - {name: floor, shape: {type: box, size: [0.5, 0.02, 0.5]}, place: {translate: [0, -0.01, 0]}, motion: [fixed]}\n"
         "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, place: {translate: [0, 0.055, 0]},\n"
         "     velocity: " + velocity + ", energies: [{type: neo_hookean, young: " + young + "}]}\n"
         "contact:\n  distance: 1 mm\n" + contact;
}

const std::string two_cubes =
    "objects:\n"
    "  - {name: a, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, velocity: [0, 0.5, 0],\n"
    "     energies: [{type: neo_hookean, young: 1 MPa}]}\n"
    "  - {name: b, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, velocity: [0, -0.5, 0],\n"
    "     place: {translate: [0.01, 0.103, 0.007]}, energies: [{type: neo_hookean, young: 1 MPa}]}\n"
    "contact:\n  distance: 1 mm\n";

std::vector<std::string> dynamic_integrators() {
  std::vector<std::string> names;
  for (const std::string& name : Registry<TimeIntegrator>::kind().names())
    if (Registry<TimeIntegrator>::make(name)->inertia()) names.push_back(name);
  return names;
}

double stored(const TestRun& run) { return stored_energy(energies_by_term(*run.world, run.state())); }

Vec3 momentum(const TestRun& run) {
  Vec3 sum = Vec3::Zero();
  for (int b = 0; b < run.world->dofs.block_count(); ++b) {
    const int v = run.world->dofs.vertex_of_block(b);
    sum += run.world->mass(v) * vertex(run.state().v, v);
  }
  return sum;
}

// Returns the largest increase of energy from any time to a later one, over the energy at the start.
double growth(const std::string& yaml, int steps) {
  TestRun run(yaml);
  const double start = stored(run);
  double lowest = start, largest = 0;
  for (int i = 0; i < steps; ++i) {
    run.step();
    const double energy = stored(run);
    lowest = std::min(lowest, energy);
    largest = std::max(largest, energy - lowest);
  }
  return largest / start;
}

}  // namespace

TEST_CASE("an impact gains no energy for any step size", "[stepping]") {
  const std::map<std::string, std::string> scenes = {
      {"soft block", block_on_floor("[0, -1, 0]", "", "1e5")},
      {"stiff block", block_on_floor("[0, -1, 0]", "", "1e6")},
      {"oblique with friction", block_on_floor("[1, -1, 0.3]", "  friction: {mu: 0.5}\n", "1e6")},
      {"two free cubes", two_cubes}};
  for (const auto& [name, scene] : scenes) {
    for (const std::string& integrator : dynamic_integrators()) {
      // These rely on repeated steps, which tolerate gains of 0.01 each.
      const double tolerated = integrator == "sdirk2" || integrator == "documented_sdirk3" ? 0.05 : 0.01;
      for (const double h : {0.02, 0.01, 0.005, 0.002}) {
        INFO(name << " " << integrator << " h " << h << " s");
        CHECK(growth(header(integrator, h) + scene, std::max(12, int(0.04 / h))) <= tolerated);
      }
    }
  }
}

TEST_CASE("a resolved impact gains no energy, and Newmark conserves most of it", "[stepping]") {
  for (const std::string integrator : {"bdf2", "newmark"}) {
    INFO(integrator);
    TestRun run(header(integrator, 5e-4) + two_cubes);
    const double start = stored(run);
    for (int i = 0; i < 60; ++i) {
      const StepReport report = run.step();
      CHECK_FALSE(report.flows.gained);
      CHECK_FALSE(report.flows.damped);
    }
    CHECK(stored(run) <= 1.001 * start);
    CHECK(stored(run) >= (integrator == "newmark" ? 0.75 : 0.25) * start);
    CHECK(momentum(run).norm() <= 1e-6 * 0.5);  // none at the start
    CHECK(run.warnings.empty());
  }
}

TEST_CASE("adhering surfaces meet without energy gain", "[stepping]") {
  const std::string sticky = block_on_floor(
      "[0, -1, 0]", "  pairs: [{between: [block, floor], adhesion: {type: fang, peak_traction: 3 kPa}}]\n", "1e6");
  for (const std::string integrator : {"bdf2", "newmark"})
    for (const double h : {0.02, 0.01, 0.005}) {
      INFO(integrator << " h " << h << " s");
      CHECK(growth(header(integrator, h) + sticky, 12) <= 0.01);
    }
}

// A stiff block rests on a soft barrier and is set swinging, so gently that contact lasts.
TEST_CASE("integrators keep their order in lasting contact", "[stepping]") {
  const auto height = [](const std::string& integrator, int steps) {
    constexpr double duration = 0.06;  // s
    TestRun run(fmt::format(
        "time: {{step: {}, duration: 10, integrator: {}}}\n"
        "solver: {{type: projected_newton, linear: cholmod, tolerance: 1e-9}}\n"
        "objects:\n"
        "  - {{name: floor, shape: {{type: box, size: [0.5, 0.02, 0.5]}}, place: {{translate: [0, -0.01, 0]}}, motion: [fixed]}}\n"
        "  - {{name: block, shape: {{type: box, size: [0.1, 0.1, 0.1]}}, place: {{translate: [0, 0.0571, 0]}},\n"
        "     velocity: [0, -0.03, 0], energies: [{{type: neo_hookean, young: 1e7}}]}}\n"
        "contact: {{distance: 10 mm, barrier: {{type: clamped_log, stiffness: 3 kPa}}}}\n"
        "gravity: [0, -9.81, 0]\n"
        "probes: [{{name: height, type: centre_of_mass, object: block, direction: [0, 1, 0]}}]\n",
        duration / steps, integrator));
    for (int i = 0; i < steps; ++i) REQUIRE(run.step().contacts > 0);
    return run.sample(0)[0];
  };
  const double reference = height("newmark", 3200);
  const auto error = [&](const std::string& integrator, int steps) {
    return std::abs(height(integrator, steps) - reference);
  };
  CHECK(std::log2(error("implicit_euler", 100) / error("implicit_euler", 200)) == Approx(1).margin(0.2));
  for (const std::string integrator : {"bdf2", "newmark", "generalised_alpha", "sdirk2", "tr_bdf2"}) {
    const double coarse = error(integrator, 50), fine = error(integrator, 200);
    INFO(integrator << ": errors " << coarse << " " << fine << " m");
    CHECK(std::log2(coarse / fine) / 2 >= 1.8);
    CHECK(fine <= 3e-7);
  }
}

namespace {

// Returns the tangential over the normal impulse, divided by mu, of a block that is thrown obliquely at
// a floor. sizes: step sizes in turn, in units of that of the scene.
double impulse_ratio(const std::string& integrator, double h, const std::vector<double>& sizes) {
  constexpr double mu = 0.3;
  TestRun run(fmt::format("time: {{step: {}, duration: 10, integrator: {}}}\n"
                          "solver: {{type: projected_newton, linear: cholmod, tolerance: 0.1 mm/s}}\n"
                          "objects:\n"
                          "  - {{name: floor, shape: {{type: box, size: [2, 0.02, 0.5], cells: [9, 1, 3]}},\n"
                          "     place: {{translate: [0.5, -0.01, 0]}}, motion: [fixed]}}\n"
                          "  - {{name: block, shape: {{type: box, size: [0.2, 0.05, 0.2], cells: [4, 1, 4]}},\n"
                          "     place: {{translate: [0, 0.0363, 0]}}, velocity: [2, -1, 0],\n"
                          "     energies: [{{type: neo_hookean, young: 2 MPa, poisson: 0.3}}]}}\n"
                          "contact: {{distance: 1 mm, friction: {{mu: {}}}}}\n", h, integrator, mu));
  const Vec3 start = momentum(run);
  for (int i = 0; run.state().time < 0.06; ++i) {
    const double size = sizes[i % sizes.size()] * h;
    for (size_t stage = 0; stage < run.config.time.integrator->stages().size(); ++stage) {
      const SolveResult result = run.stepper.solve(size);
      REQUIRE(run.stepper.validate(result).fault.empty());
      run.stepper.commit(result.x, size);
    }
  }
  const Vec3 given = momentum(run) - start;
  CHECK(given.y() > start.norm() / 4);  // it has been stopped
  return -given.x() / given.y() / mu;
}

}  // namespace

TEST_CASE("lagged friction applies mu times the normal impulse of an impact, for every integrator", "[stepping][friction]") {
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark", "generalised_alpha", "tr_bdf2"})
    for (const double h : {0.01, 0.002, 0.0005}) {
      INFO(integrator << " h " << h << " s");
      CHECK(impulse_ratio(integrator, h, {1}) == Approx(1).epsilon(0.02));
    }
}

TEST_CASE("lagged friction applies mu times the normal impulse of an impact, for any size of the next step", "[stepping][friction]") {
  const std::vector<std::vector<double>> sizes = {
      {1, 0.5, 0.5}, {0.5, 0.5, 1}, {0.5, 1, 0.5}, {1, 1, 0.5, 0.5}, {0.5, 0.5, 1, 1}, {1, 0.25, 0.25, 0.25, 0.25},
      {0.25, 0.25, 0.25, 0.25, 1}, {0.25, 0.25, 1, 0.25, 0.25}, {0.25, 1, 0.25, 0.25, 0.25}, {0.25, 0.25, 0.5, 1, 0.5, 0.125, 0.125},
      {0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 1}};
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"})
    for (size_t i = 0; i < sizes.size(); ++i)
      for (const double h : {0.01, 0.004, 0.002}) {
        INFO(integrator << " h " << h << " s, sizes " << i);
        CHECK(impulse_ratio(integrator, h, sizes[i]) == Approx(1).epsilon(0.02));
      }
}
