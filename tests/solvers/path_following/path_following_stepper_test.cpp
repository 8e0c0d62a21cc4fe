// Paths with snap-back and snap-through against closed forms, and what the stepper refuses.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "geometry/errors.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A strip with a crack of length a at its left end, peeled off by a machine of stiffness k: P a = sqrt(2 W b E I), deflection P a^3 / (3 E I).
struct Strip {
  double young = 1e9, thickness = 1e-3, width = 2e-3, length = 0.06, crack = 0.02, work = 0.5, strength = 2e5, machine = 10.0 / 3;
  double rate = 1e-6;  // of dissipation [W]
  int cells = 120;
  std::string stepper = "path_following";

  double bending() const { return young * width * std::pow(thickness, 3) / 12; }
  double load(double a) const { return std::sqrt(2 * work * width * bending()) / a; }
  double release(double load, double a) const { return load * load * a * a / (2 * width * bending()); }
  double machine_displacement(double a) const { return load(a) * (1 / machine + a * a * a / (3 * bending())); }
  std::string scene(double step, double duration) const {
    return fmt::format(
        "objects:\n"
        "  - {{name: base, shape: {{type: grid, size: [0.05, 0.004], cells: [100, 2]}}, place: {{translate: [0.035, 0, 0]}}, motion: [fixed]}}\n"
        "  - name: strip\n    shape: {{type: grid, size: [{}, {}], cells: [{}, 1]}}\n    place: {{translate: [{}, 60e-6, 0]}}\n    shell: {{thickness: {}}}\n"
        "    energies: [{{type: stvk_membrane, young: {}, poisson: 0}}, {{type: hinge_bending, young: {}, poisson: 0}}]\n    motion:\n"
        "      - {{type: fixed, along: [0, 0, 1]}}\n      - {{type: fixed, select: {{type: face, direction: [1, 0, 0]}}}}\n"
        "  - {{name: machine, shape: {{type: grid, size: [0.001, {}]}}, place: {{translate: [0.0005, 0.02, 0]}}, motion: [{{type: formula, y: 1e-3 * t}}]}}\n"
        "interactions:\n  - {{name: compliance, type: spring, from: {{object: strip, select: {{type: face, direction: [-1, 0, 0]}}}}, "
        "to: {{object: machine, select: {{type: face, direction: [-1, 0, 0]}}}}, stiffness: {}}}\n"
        "contact:\n  distance: 50e-6\n  barrier: {{type: clamped_log, stiffness: 1 MPa}}\n  pairs:\n"
        "    - {{between: [{{object: strip, select: {{type: formula, where: x > {}}}}}, base], bond_distance: 78e-6, "
        "adhesion: {{type: bilinear, peak_traction: {}, work_of_adhesion: {}}}}}\n"
        "    - {{between: [strip, strip], contact: false}}\n"
        "time: {{step: {}, duration: {}, integrator: quasi_static, stepper: {{type: {}{}}}}}\n"
        "probes:\n  - {{name: load, type: spring_force, interaction: compliance}}\n"
        "  - {{name: deflection, type: separation, direction: [0, 1, 0], from: {{object: base}}, to: {{object: strip, select: {{type: face, direction: [-1, 0, 0]}}}}}}\n"
        "  - {{name: intact, type: bonds, between: [strip, base], quantity: intact_area}}\n",
        length, width, cells, length / 2, thickness, young, young, width, machine / 2, crack - 1e-6, strength, work, step, duration, stepper,
        stepper == "path_following" ? fmt::format(", dissipation_rate: {}", rate) : "");
  }
};

double metric(const TestRun& run, const std::string& name) {
  for (const StepMetric& m : run.world->step_metrics)
    if (m.name == name) return m.value;
  FAIL(name);
  return 0;
}

}  // namespace

TEST_CASE("a peel snaps back along the path of linear elastic fracture", "[path_following]") {
  const Strip strip{.rate = 0.7e-6};  // 0.7 of an element per step
  TestRun run(strip.scene(0.5, 45));
  const double apart = run.sample(1)[0];
  double largest = 0, steps = 0, first_intact = 0, first_time = 0;
  while (!run.stepper.finished()) {
    run.step();
    const double load = run.sample(0)[1], deflection = run.sample(1)[0] - apart, time = metric(run, "load_time");
    largest = std::max(largest, time);
    if (largest == time) continue;
    const double a = std::cbrt(3 * strip.bending() * deflection / load);  // from the compliance
    if (a > 0.04) break;
    if (a < strip.crack + 3e-3) continue;
    INFO(run.state().time << " " << a << " " << time);
    CHECK(strip.release(load, a) == Approx(strip.work).epsilon(0.03));
    CHECK(time == Approx(1e3 * strip.machine_displacement(a)).epsilon(0.02));
    if (++steps == 1) first_intact = run.sample(2)[0], first_time = run.state().time;
    // The front grows by rate / W.
    if (steps > 10) CHECK((first_intact - run.sample(2)[0]) / (run.state().time - first_time) == Approx(strip.rate / strip.work).epsilon(0.02));
  }
  CHECK(steps >= 20);
  CHECK(largest > 1e3 * strip.machine_displacement(0.03));
}

// F = 2 k (l_0 - l) (H - w) / l, l^2 = B^2 + (H - w)^2, for a displacement w of the apex (von Mises 1923).
TEST_CASE("a shallow truss snaps through along its load path by arc length", "[path_following]") {
  const double half = 1, height = 0.2, stiffness = 1000, l0 = std::hypot(half, height);
  TestRun run(
      "gravity: [0, 0, 0]\n"
      "objects:\n"
      "  - {name: supports, shape: {type: points, size: [2, 0, 0], counts: [2, 1, 1]}, particle: {radius: 1 mm}, motion: [fixed]}\n"
      "  - {name: apex, shape: {type: points}, place: {translate: [0, 0.2, 0]}, particle: {radius: 1 mm}, energies: [{type: particle, mass: 1}], "
      "motion: [{type: fixed, along: [0, 0, 1]}], loads: [{type: force, value: [0, -1, 0], ramp: [[-100, -100], [100, 100]]}]}\n"
      "interactions:\n  - {name: bars, type: spring, from: {object: supports}, to: {object: apex}, stiffness: 1000}\n"
      "time: {step: 1, duration: 19, integrator: quasi_static, stepper: {type: path_following, arc_speed: 0.02}}\n");
  const int apex = run.world->vertices_of(run.world->index_of("apex")).front();
  double most = 0, least = 0, unstable = 0;
  while (!run.stepper.finished()) {
    const double before = run.at(apex).y();
    run.step();
    const double y = run.at(apex).y(), l = std::hypot(half, y), load = metric(run, "load_time");
    INFO(run.state().time << " " << y << " " << load);
    CHECK(before - y == Approx(0.02).epsilon(1e-3));
    CHECK(load == Approx(2 * stiffness * (l0 - l) * y / l).margin(1e-3));
    most = std::max(most, load), least = std::min(least, load);
    unstable += metric(run, "negative_pivots");
  }
  // Limit points of a shallow truss: y = H / sqrt 3, F = 2 k H^3 / (3 sqrt 3 B^3).
  const double limit = 2 * stiffness * std::pow(height / l0, 3) / std::sqrt(27);
  CHECK(most == Approx(limit).epsilon(0.06));
  CHECK(least == Approx(-limit).epsilon(0.06));
  CHECK(unstable >= 8);
}

// The law is a triangle: its traction falls from 1 kPa at a gap of 1 mm to none at 2 mm, beyond the barrier.
TEST_CASE("a dead load that may fall traces the law of contact adhesion beyond its peak", "[path_following]") {
  TestRun run(
      "gravity: [0, 0, 0]\n"
      "objects:\n"
      "  - {name: upper, shape: {type: box, size: [0.1, 0.01, 0.1], cells: [3, 1, 3]}, place: {translate: [0, 0.005125, 0]}, motion: [fixed]}\n"
      "  - {name: lower, shape: {type: box, size: [0.1, 0.01, 0.1], cells: [4, 1, 4]}, place: {translate: [0, -0.005125, 0]}, "
      "energies: [{type: neo_hookean, young: 10 MPa, poisson: 0.3, density: 1000}], motion: [{type: fixed, along: [1, 0, 0]}, {type: fixed, along: [0, 0, 1]}], "
      "loads: [{type: traction, value: [0, -1000, 0], ramp: [[0, 0], [2, 2]], select: {type: face, direction: [0, -1, 0]}}]}\n"
      "contact: {distance: 1 mm, pairs: [{between: [lower, upper], adhesion: {type: fang, young: 10 kPa, critical_strain: 0.1}}]}\n"
      "time: {step: 0.05, duration: 2.2, integrator: quasi_static, stepper: {type: path_following, dissipation_rate: 4.6e-3}}\n"
      "probes:\n  - {name: gap, type: separation, from: {object: lower, select: {type: face, direction: [0, 1, 0]}}, "
      "to: {object: upper, select: {type: face, direction: [0, -1, 0]}}, direction: [0, 1, 0]}\n");
  double peak = 0, work = 0, first_gap = 0, gap = 0;
  int beyond = 0;
  while (!run.stepper.finished()) {
    const StepReport report = run.step();
    gap = run.sample(0)[0];
    peak = std::max(peak, metric(run, "load_time"));
    if (gap < 1.01e-3) continue;
    INFO(run.state().time << " " << gap);
    if (++beyond == 1) {
      first_gap = gap;
      continue;
    }
    CHECK(metric(run, "load_time") == Approx(2 - gap / 1e-3).margin(2e-3));
    CHECK(metric(run, "path_work") == Approx(4.6e-3 * 0.05).epsilon(1e-3));
    CHECK(std::abs(report.flows.numerics) < 1e-6 * metric(run, "path_work"));
    work += report.flows.loads;
  }
  CHECK(beyond >= 15);
  CHECK(peak == Approx(1).epsilon(0.01));
  // 10 N times the integral of 2 - gap / 1 mm.
  const auto integral = [](double d) { return 10 * (2 * d - d * d / 2e-3); };
  CHECK(work == Approx(integral(gap) - integral(first_gap)).epsilon(2e-3));
}

TEST_CASE("path following refuses what time drives", "[path_following]") {
  const auto scene = [](const std::string& time, const std::string& contact, const std::string& block) {
    return "time: {step: 0.1, duration: 1, " + time +
           "}\nobjects:\n"
           "  - {name: plate, shape: {type: box, size: [0.2, 0.1, 0.2]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n"
           "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.0505, 0]}, "
           "energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]" +
           block + "}\ncontact: {distance: 0.4 mm" + contact + "}\n";
  };
  const auto refusal = [&](const std::string& time, const std::string& contact = "", const std::string& block = "") -> std::string {
    try {
      TestRun run(scene(time, contact, block));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string follow = "integrator: quasi_static, stepper: {type: path_following, arc_speed: 1e-3}";
  const auto bonded = [](const std::string& law) { return ", pairs: [{between: [block, plate], bond_distance: 0.6 mm, adhesion: {type: " + law + "}}]"; };
  CHECK(refusal(follow) == "");
  CHECK(refusal(follow, bonded("bilinear, peak_traction: 800, work_of_adhesion: 0.02")) == "");
  CHECK_THAT(refusal("stepper: {type: path_following, arc_speed: 1e-3}"), Catch::Contains("time.integrator is implicit_euler"));
  CHECK_THAT(refusal("integrator: quasi_static, stepper: path_following"), Catch::Contains("either dissipation_rate or arc_speed"));
  CHECK_THAT(refusal("adaptive: {error: 1e-4}, " + follow), Catch::Contains("time.adaptive"));
  CHECK_THAT(refusal(follow, ", friction: {mu: 0.3}"), Catch::Contains("friction"));
  CHECK_THAT(refusal(follow, bonded("viscoelastic, peak_traction: 800, work_of_adhesion: 0.02, relaxation_time: 1")), Catch::Contains("rates"));
  CHECK_THAT(refusal(follow, "", ", motion: [{type: fixed, until: 0.5}]"), Catch::Contains("begins or ends"));
  CHECK_THAT(refusal(follow, "", ", loads: [{type: pressure, value: 10}]"), Catch::Contains("follows the configuration"));
}
