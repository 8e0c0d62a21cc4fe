// Friction within time steps: sliding under each integrator, substeps, the fixed-point loop.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/contact/terms/friction_term.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

// A block of 1 kg slides over a floor at 4 m/s, pressed on by 10 N that may grow to 50 N.
struct Slide {
  std::string integrator = "implicit_euler", ramp = "1", lagging = "{iterations: 1}";
  double h = 2e-3;
  double duration = 0.2;
  int max_iterations = 500;
  double speed = 4;
  std::string pull = "0";  // m/s^2 along the floor

  std::string yaml() const {
    return fmt::format(
        "time: {{step: {}, duration: {}, integrator: {}}}\n"
        "objects:\n"
        "  - {{name: floor, shape: {{type: box, size: [2, 0.02, 0.3], cells: [11, 1, 3]}},\n"
        "     place: {{translate: [0.5, -0.01, 0]}}, motion: [fixed]}}\n"
        "  - name: block\n"
        "    shape: {{type: box, size: [0.2, 0.05, 0.1], cells: [4, 1, 2]}}\n"
        "    place: {{translate: [0, 0.025943376, 0]}}\n"
        "    velocity: [{}, 0, 0]\n"
        "    energies: [{{type: neo_hookean, young: 10 MPa, poisson: 0.3}}]\n"
        "    loads: [{{type: body_force, value: [0, -10, 0], ramp: {}}},\n"
        "            {{type: body_force, value: [1, 0, 0], ramp: {}}}]\n"
        "contact:\n  distance: 1 mm\n  barrier: {{type: clamped_log, stiffness: 50 kPa}}\n"
        "  friction: {{mu: 0.5, eps_v: 1 mm/s}}\n  lagging: {}\n"
        "solver: {{type: projected_newton, tolerance: 1e-6, max_iterations: {}}}\n",
        h, duration, integrator, speed, ramp, pull, lagging, max_iterations);
  }
};

constexpr int block = 1, ground = 0;

struct Run {
  double distance = 0, speed = 0;             // of the centre of mass [m], [m/s]
  double friction = 0, pressing = 0;          // means over the steps [N]
  int largest_lag = 0;                        // iterations
  double largest_residual = 0, last_residual = 0;
  std::vector<Warning> warnings;
  std::vector<StepReport> reports;
};

Run run(const Slide& slide) {
  TestScene scene(slide.yaml());
  World& world = *scene.world;
  Run r;
  TimeStepper stepper(world, scene.config, scene.config.time, *scene.solver, scene.clock, [&](const Warning& w) { r.warnings.push_back(w); });
  const auto mean = [&](const VecX& rows) {
    Vec3 sum = Vec3::Zero();
    for (int v = 0; v < world.mass.size(); ++v) sum += world.mass(v) * vertex(rows, v);
    return Vec3(sum / world.mass.sum());
  };
  const double start = mean(stepper.state().x).x();
  while (!stepper.finished()) {
    const StepReport report = stepper.advance();
    const VecX& x = stepper.state().x;
    r.friction -= report.step_size * world.friction->force_between(x, TangentialTerm::all, {block, ground}).x();
    r.pressing += report.step_size * contact_term(world).force_between(x, LawTerm::barrier, {block, ground}).y();
    r.largest_lag = std::max(r.largest_lag, report.lag_iterations);
    r.largest_residual = std::max(r.largest_residual, report.friction_residual);
    r.reports.push_back(report);
  }
  r.friction /= slide.duration;
  r.pressing /= slide.duration;
  r.distance = mean(stepper.state().x).x() - start;
  r.speed = mean(stepper.state().v).x();
  return r;
}

}  // namespace

TEST_CASE("a sliding block feels mu N under every integrator", "[friction]") {
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
    INFO(integrator);
    const Run r = run({.integrator = integrator});
    CHECK(r.warnings.empty());
    CHECK(r.pressing == Approx(10).epsilon(0.01));
    CHECK(r.friction == Approx(5).epsilon(0.01));
    CHECK(r.speed == Approx(4 - 5 * 0.2).epsilon(0.005));
    CHECK(r.distance == Approx(4 * 0.2 - 5 * 0.2 * 0.2 / 2).epsilon(0.005));
  }
}

TEST_CASE("a sliding block stops after v^2 / (2 mu g) and stays", "[friction]") {
  const Run r = run({.integrator = "bdf2", .h = 1e-3, .duration = 0.15, .speed = 0.5});
  CHECK(r.distance == Approx(0.5 * 0.5 / (2 * 5)).epsilon(0.02));
  CHECK(std::abs(r.speed) <= 1e-4);
}

TEST_CASE("fully implicit friction is nearer to small steps than lagged friction", "[friction]") {
  const Slide growing{.integrator = "bdf2", .ramp = "[[0, 1], [0.2, 5]]", .h = 0.01};
  Slide fine = growing, implicit = growing;
  fine.h /= 100;
  implicit.lagging = "{iterations: 50, until: 1e-4}";
  const double reference = 4 * 0.2 - 5 * 0.2 * 0.2 / 2 - 20 / 0.2 * std::pow(0.2, 3) / 6;  // of a block that does not hop
  CHECK(run(fine).distance == Approx(reference).margin(3e-4));
  const Run lagged = run(growing), solved = run(implicit);
  CHECK(std::abs(solved.distance - reference) < 0.25 * std::abs(lagged.distance - reference));
  CHECK(lagged.largest_lag == 1);
  CHECK(lagged.largest_residual > 0.01);  // a warning is given
  CHECK(solved.largest_lag > 1);
  CHECK(solved.largest_residual <= 1e-4);
  CHECK_FALSE(warned(solved.warnings, WarningKind::lagged_friction));
  CHECK_FALSE(warned(solved.warnings, WarningKind::friction_impulse));
}

TEST_CASE("lag iterations that do not converge are warned of", "[friction]") {
  const Run r = run({.ramp = "[[0, 1], [0.2, 5]]", .lagging = "{iterations: 2, until: 1e-12}", .h = 0.02});
  CHECK(r.warnings.size() == r.reports.size());
  CHECK_THAT(first_text(r.warnings, WarningKind::lagged_friction), Catch::Contains("contact.lagging.until"));
  for (const StepReport& report : r.reports) {
    CHECK(report.converged);
    CHECK_FALSE(report.lag_converged);
    CHECK(report.lag_iterations == 2);
    CHECK(report.friction_residual > 1e-12);
  }
}

// Substeps after failed solves have the same friction: eps_v h follows h, and u starts at zero.
TEST_CASE("friction is independent of step cutbacks", "[friction]") {
  const Run r = run({.h = 0.05, .max_iterations = 5});
  double smallest = 1;
  for (const StepReport& report : r.reports) smallest = std::min(smallest, report.step_size);
  CHECK(smallest < 0.05);
  CHECK(r.friction == Approx(5).epsilon(0.02));
  CHECK(r.speed == Approx(3).epsilon(0.01));
}

// A lasting normal force is the same force in steps of any size.
TEST_CASE("lasting friction does not depend on changes of the step size", "[friction]") {
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
    INFO(integrator);
    TestScene scene(Slide{.integrator = integrator}.yaml());
    World& world = *scene.world;
    TimeStepper stepper(world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
    const std::vector<double> sizes = {1, 0.5, 0.5, 2, 2, 0.25, 1};
    double rubbing = 0, pressing = 0;  // N s
    for (int i = 0; i < 35; ++i) {
      const double h = sizes[i % sizes.size()] * 2e-3;
      stepper.commit(stepper.solve(h).x, h);
      const VecX& x = stepper.state().x;
      const double force = -world.friction->force_between(x, TangentialTerm::all, {block, ground}).x();
      CHECK(force == Approx(5).epsilon(0.06));  // the block bounces
      rubbing += h * force;
      pressing += h * contact_term(world).force_between(x, LawTerm::barrier, {block, ground}).y();
    }
    CHECK(rubbing / pressing == Approx(0.5).epsilon(0.02));
  }
}

TEST_CASE("a quasi-static block creeps by the slip law", "[friction]") {
  const Run r = run({.integrator = "quasi_static", .h = 0.1, .duration = 2, .speed = 0, .pull = "[[0, 0], [2, 4]]"});
  double creep = 0;
  for (int i = 1; i <= 20; ++i) creep += 1e-3 * 0.1 * (1 - std::sqrt(1 - 0.2 * i / 5));
  CHECK(r.distance == Approx(creep).epsilon(0.01));
  CHECK(r.friction == Approx(0.2 * 10.5).epsilon(1e-3));
}

TEST_CASE("without friction there are no lag iterations", "[friction]") {
  TestScene scene("time: {step: 0.01, duration: 0.02}\n"
                  "objects: [{name: a, shape: {type: box, size: [1, 1, 1]}, energies: [{type: neo_hookean, young: 1e5}]}]\n"
                  "contact: {distance: 1e-3, friction: {mu: 0}}\n");
  CHECK_FALSE(scene.world->friction);
  TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
  const StepReport report = stepper.advance();
  CHECK(report.lag_iterations == 0);
  CHECK(report.friction_residual == 0);
  for (const NamedEnergy& energy : report.energies) CHECK(energy.name != "friction");
}
