// Adaptive step sizes: their errors, their ends at corners of prescribed motions, and impacts.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "framework/stepping/time_stepper.hpp"
#include "geometry/errors.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

struct Taken {
  std::vector<StepReport> steps;
  std::vector<Warning> warnings;
  State end;
  int repeats = 0;
  double largest() const {
    return std::max_element(steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.step_size < b.step_size; })->step_size;
  }
  double smallest() const {
    return std::min_element(steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.step_size < b.step_size; })->step_size;
  }
};

template <class Prepare>
Taken run(const std::string& yaml, const Prepare& prepare) {
  TestScene scene(yaml);
  prepare(*scene.world);
  Taken taken;
  TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock,
                      [&](const Warning& w) { taken.warnings.push_back(w); });
  while (!stepper.finished()) {
    taken.steps.push_back(stepper.advance());
    taken.repeats += taken.steps.back().rejections[Rejection::error];
  }
  taken.end = stepper.state();
  return taken;
}
Taken run(const std::string& yaml) {
  return run(yaml, [](World&) {});
}

std::string time_of(const std::string& integrator, double step, double duration, const std::string& adaptive) {
  return fmt::format("time: {{step: {}, duration: {}, integrator: {}{}}}\nsolver: {{type: projected_newton, tolerance: 1e-9, force_tolerance: 1e-10}}\n", step, duration,
                     integrator, adaptive.empty() ? "" : ", adaptive: {" + adaptive + "}");
}

const std::string thrown =
    "gravity: [0, -9.81, 0]\n"
    "objects: [{name: block, shape: {type: box, size: [0.1, 0.07, 0.05]}, velocity: [0.3, 4, -0.2], energies: [{type: neo_hookean, young: 1e5}]}]\n";

const std::string swinging =
    "objects: [{name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 2e4}],\n"
    "  motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}]\n";
Taken swing(const std::string& integrator, double step, const std::string& adaptive) {
  return run(time_of(integrator, step, 0.05, adaptive) + swinging, [](World& world) {
    for (int b = 0; b < world.dofs.block_count(); ++b) vertex(world.start.v, world.dofs.vertex_of_block(b)) = Vec3(1e-2, 2e-3, 0);
  });
}

}  // namespace

TEST_CASE("adaptive steps of implicit Euler in flight have the size at which h^2 g / 2 is the error", "[stepping]") {
  constexpr double error = 1e-4, g = 9.81;
  const Taken taken = run(time_of("implicit_euler", 1e-3, 1, "error: 1e-4") + thrown);
  double off = 0;
  for (const StepReport& s : taken.steps) {
    CHECK(*s.error == Approx(s.step_size * s.step_size * g / 2).epsilon(1e-5));
    CHECK(*s.error <= error);
    off += *s.error;
  }
  CHECK(taken.end.time == Approx(1).epsilon(1e-12));
  const double settled = taken.steps[taken.steps.size() / 2].step_size;
  CHECK(settled == Approx(std::sqrt(2 * 0.7 * error / g)).epsilon(0.15));  // or not worth a change
  CHECK(taken.repeats == 0);
  // The errors that the steps report add up to the error at the end.
  const Vec3 end = vertex(taken.end.x, 0), start = Vec3(-0.05, -0.035, -0.025);
  CHECK((end - start - Vec3(0.3, 4 - g / 2, -0.2)).norm() == Approx(off).epsilon(1e-3));
}

TEST_CASE("adaptive steps of second-order methods have the largest size along parabolas", "[stepping]") {
  for (const std::string integrator : {"bdf2", "newmark"}) {
    INFO(integrator);
    const Taken taken = run(time_of(integrator, 1e-3, 1, "error: 1e-4, largest: 0.05") + thrown);
    CHECK(taken.largest() == Approx(0.05));
    const Vec3 end = vertex(taken.end.x, 0), start = Vec3(-0.05, -0.035, -0.025);
    // BDF2 begins with a step of implicit Euler.
    CHECK((end - start - Vec3(0.3, 4 - 9.81 / 2, -0.2)).norm() <= (integrator == "newmark" ? 1e-7 : 1e-2));
  }
}

TEST_CASE("BDF2 of two sizes is exact under a constant acceleration", "[stepping]") {
  const Vec3 g(1, -9.81, 3), v0(0.2, 5, -1);
  const auto integrator = Registry<TimeIntegrator>::make("bdf2");
  for (const double ratio : {0.3, 0.7, 1.0, 1.3, 2.0}) {
    INFO("h / h_before = " << ratio);
    const double before = 0.01, h = ratio * before;
    const auto x = [&](double t) -> VecX { return t * v0 + t * t / 2 * g; };
    const auto v = [&](double t) -> VecX { return v0 + t * g; };
    State s;
    s.adapts = true;
    s.h_before = before;
    s.x = x(0), s.v = v(0), s.a = g;
    s.x_before = x(-before), s.v_before = v(-before);
    const TimeIntegrator::Prediction p = integrator->predict({s, h});
    const VecX end = p.x + p.scale * g;
    CHECK((end - x(h)).norm() <= 1e-14);
    VecX velocity, acceleration;
    integrator->update({s, h}, end, {}, velocity, acceleration);
    CHECK((velocity - v(h)).norm() <= 1e-11);
    CHECK((acceleration - g).norm() <= 1e-8);
    const EndVelocity linear = integrator->end_velocity({s, h});
    CHECK((linear.rate * (end - linear.still) - v(h)).norm() <= 1e-11);
    CHECK(integrator->local_error({s, h}, end, {}).x.norm() <= 1e-14);
    // For a cubic path, the estimate is the error of the step.
    const double jerk = 1e3;
    const auto cubic = [&](double t) -> VecX { return x(t) + jerk * t * t * t / 6 * VecX::Ones(3); };
    const auto slope = [&](double t) -> VecX { return v(t) + jerk * t * t / 2 * VecX::Ones(3); };
    s.x_before = cubic(-before), s.v_before = slope(-before);
    const TimeIntegrator::Prediction q = integrator->predict({s, h});
    const VecX there = q.x + q.scale * (g + jerk * h * VecX::Ones(3));
    const double missed = (cubic(h) - there).norm(), estimated = integrator->local_error({s, h}, there, {}).x.norm();
    CHECK(estimated > 0.5 * missed);
    CHECK(estimated < 2 * missed);
    s.adapts = false;  // then the first step of another size is implicit Euler
    CHECK((ratio == 1) == (integrator->predict({s, h}).scale != h * h));
  }
}

TEST_CASE("the number of adaptive steps follows the order of the method, as does the final error", "[stepping]") {
  const VecX exact = swing("newmark", 1e-5, "").end.x;
  struct Method {
    std::string name;
    double error, finer, steps;  // tolerance of the error, factor of a finer one, expected ratio of step counts
  };
  for (const Method& m : {Method{"implicit_euler", 1e-6, 1e-2, 10}, Method{"bdf2", 1e-7, 1e-3, 10}, Method{"newmark", 1e-7, 1e-3, 10}}) {
    INFO(m.name);
    const double error = m.error;
    const std::string limits = ", smallest: 1e-7, largest: 0.01";
    const Taken coarse = swing(m.name, 1e-4, fmt::format("error: {}", error) + limits);
    const Taken fine = swing(m.name, 1e-4, fmt::format("error: {}", error * m.finer) + limits);
    CHECK(static_cast<double>(fine.steps.size()) / static_cast<double>(coarse.steps.size()) == Approx(m.steps).epsilon(0.4));
    CHECK((fine.end.x - exact).norm() < 0.3 * (coarse.end.x - exact).norm());
    for (const StepReport& s : fine.steps) CHECK(*s.error <= error * m.finer);
  }
}

TEST_CASE("steps are small at an impact, and large before and after it", "[stepping]") {
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
    INFO(integrator);
    const Taken taken = run(time_of(integrator, 1e-3, 0.3, "error: 0.1e-3, largest: 20e-3, smallest: 0.01e-3") +
                            "gravity: [0, -9.81, 0]\n"
                            "contact: {distance: 1e-3}\n"
                            "objects:\n"
                            "  - {name: floor, shape: {type: box, size: [0.3, 0.02, 0.3]}, place: {translate: [0, -0.01, 0]}, motion: [fixed]}\n"
                            "  - {name: block, shape: {type: box, size: [0.05, 0.05, 0.05]}, place: {translate: [0, 0.1, 0]},\n"
                            "     velocity: [0, -1, 0], energies: [{type: neo_hookean, young: 1e6}]}\n");
    CHECK(taken.repeats > 0);
    double in_flight = 0, at_smallest = 0;
    for (const StepReport& s : taken.steps) {
      CHECK((*s.error <= 0.1e-3 || s.step_size <= 0.01e-3 * (1 + 1e-9)));
      if (s.step_size == taken.smallest()) at_smallest = s.time;
      if (s.time < 0.05) in_flight = std::max(in_flight, s.step_size);
    }
    CHECK(at_smallest > 0.05);  // falls 75 mm from 1 m/s on
    CHECK(in_flight > 8 * taken.smallest());
    CHECK(taken.end.time == Approx(0.3).epsilon(1e-12));
  }
}

TEST_CASE("adaptive steps end at corners of prescribed motions", "[stepping]") {
  const Taken taken = run(time_of("implicit_euler", 1e-3, 0.2, "error: 1e-3, largest: 0.03") +
                          "objects: [{name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 1e5}],\n"
                          "  motion: [{type: keyframes, until: 0.17123, frames: [{time: 0.0137, translation: [0, 0, 0]}, {time: 0.1011, translation: [0.01, 0, 0]}],\n"
                          "            select: {type: face, direction: [0, -1, 0]}}],\n"
                          "  loads: [{type: body_force, value: [0, 1, 0], ramp: [[0.05, 0], [0.0777, 1]]}]}]\n");
  for (const double corner : {0.0137, 0.05, 0.0777, 0.1011, 0.17123, 0.2}) {
    INFO(corner);
    CHECK(std::any_of(taken.steps.begin(), taken.steps.end(), [&](const StepReport& s) { return std::abs(s.time - corner) < 1e-12; }));
  }
  CHECK(taken.steps.size() < 60);
}

TEST_CASE("adaptive steps end at changes of motor targets", "[stepping]") {
  const Taken taken = run(time_of("implicit_euler", 1e-3, 0.2, "error: 1e-3, largest: 0.03") +
                          "objects: [{name: bar, shape: {type: box, size: [0.01, 0.2, 0.05]}, body: {type: affine, density: 1000}}]\n"
                          "interactions: [{type: hinge, name: hinge, object: bar, at: [0, 0, 0], axis: [0, 0, 1], motor: {speed: [[0.0611, 0], [0.1234, 1]], torque: 1}}]\n");
  for (const double corner : {0.0611, 0.1234, 0.2}) {
    INFO(corner);
    CHECK(std::any_of(taken.steps.begin(), taken.steps.end(), [&](const StepReport& s) { return std::abs(s.time - corner) < 1e-12; }));
  }
}

namespace {

// A block that falls on a floor and slides. unit: of length; densities and moduli are scaled so that dimensionless numbers stay.
std::string sliding(double unit) {
  return fmt::format("time: {{step: 1e-3, duration: 0.2, integrator: bdf2, adaptive: {{error: {0}, largest: 20e-3, smallest: 0.01e-3}}}}\n"
                     "solver: {{type: projected_newton, tolerance: {1}}}\n"
                     "gravity: [0, {2}, 0]\n"
                     "contact: {{distance: {3}, friction: {{mu: 0.3, eps_v: {4}}}}}\n"
                     "objects:\n"
                     "  - {{name: floor, shape: {{type: box, size: [{5}, {6}, {5}]}}, place: {{translate: [0, {7}, 0]}}, motion: [fixed]}}\n"
                     "  - {{name: block, shape: {{type: box, size: [{8}, {8}, {8}], cells: [2, 2, 2]}}, place: {{translate: [0, {9}, 0]}}, velocity: [{10}, {11}, 0],\n"
                     "     energies: [{{type: neo_hookean, young: {12}, density: 1000}}]}}\n",
                     0.1e-3 * unit, 1e-5 * unit, -9.81 * unit, 1e-3 * unit, 0.01 * unit, 0.4 * unit, 0.02 * unit, -0.01 * unit, 0.05 * unit, 0.05 * unit, 0.3 * unit, -1 * unit,
                     1e5 * unit * unit);
}

}  // namespace

TEST_CASE("adaptive steps are the same with any number of threads", "[stepping]") {
  const auto with = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    return run(sliding(1));
  };
  const Taken one = with(1), two = with(2);
  CHECK(one.end.x == two.end.x);
  CHECK(one.end.time == two.end.time);
  CHECK(one.steps.size() == two.steps.size());
}

TEST_CASE("adaptive steps are the same in other units", "[stepping]") {
  const Taken here = run(sliding(1)), there = run(sliding(1e-3));
  CHECK(static_cast<double>(there.steps.size()) == Approx(static_cast<double>(here.steps.size())).epsilon(0.1));
  CHECK(there.smallest() == Approx(here.smallest()).epsilon(0.5));
  CHECK((1e3 * there.end.x - here.end.x).lpNorm<Eigen::Infinity>() < 1e-3);
}

TEST_CASE("quasi-static steps grow on straight paths and shrink at their bends", "[stepping]") {
  const Taken taken = run(time_of("quasi_static", 0.01, 1, "error: 1e-5, largest: 0.1, smallest: 1e-4") +
                          "objects: [{name: bar, shape: {type: box, size: [0.5, 0.1, 0.1], cells: [5, 2, 2]}, energies: [{type: neo_hookean, young: 1e5}],\n"
                          "  motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}},\n"
                          "    {type: keyframes, frames: [{time: 0}, {time: 0.5, translation: [0.01, 0, 0]}, {time: 1, translation: [0.01, 0.05, 0]}],\n"
                          "     select: {type: face, direction: [1, 0, 0]}}]}]\n");
  double before = 0, after = 1;
  for (const StepReport& s : taken.steps) {
    if (s.time <= 0.5 + 1e-9) before = std::max(before, s.step_size);
    else if (s.time < 0.6) after = std::min(after, s.step_size);
    CHECK(*s.error <= 1e-5);
  }
  CHECK(before == Approx(0.1));
  CHECK(after < 0.02);
}

TEST_CASE("the smallest step is accepted with any error, with a warning", "[stepping]") {
  const Taken taken = run(time_of("implicit_euler", 1e-2, 0.1, "error: 1e-7, smallest: 2e-3") + thrown);
  CHECK(taken.smallest() == Approx(2e-3));
  CHECK(*taken.steps.back().error > 1e-7);
  CHECK_THAT(first_text(taken.warnings, WarningKind::step_error), Catch::Contains("time.adaptive.smallest"));
}

TEST_CASE("a failed solve of an adaptive step is repeated with substeps", "[stepping]") {
  const Taken taken = run("time: {step: 0.02, duration: 0.06, max_cutbacks: 12, adaptive: {error: 0.1}}\n"
                          "solver: {type: projected_newton, tolerance: 0.5, max_iterations: 1}\n"
                          "objects: [{name: bar, shape: {type: box, size: [0.4, 0.1, 0.1], cells: [4, 1, 1]},\n"
                          "  velocity: [6, 8, 0], energies: [{type: neo_hookean, young: 1e5}],\n"
                          "  motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}]}]\n");
  int halvings = 0;
  for (const StepReport& s : taken.steps) halvings += s.rejections.cutbacks();
  CHECK(halvings > 0);
  CHECK(taken.end.time == Approx(0.06).epsilon(1e-12));
}

TEST_CASE("sizes of adaptive steps that contradict each other are refused", "[stepping]") {
  const auto refusal = [](const std::string& adaptive) -> std::string {
    try {
      TestScene scene(time_of("implicit_euler", 1e-3, 1, adaptive) + thrown);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(refusal("error: 1e-4") == "");
  CHECK_THAT(refusal("error: 1e-4, smallest: 2e-3"), Catch::Contains("smallest"));
  CHECK_THAT(refusal("error: 1e-4, largest: 0.5e-3"), Catch::Contains("largest"));
  CHECK_THAT(refusal("error: 1e-4, smallest: 1e-12"), Catch::Contains("smallest"));
  CHECK_THAT(refusal("smallest: 1e-4"), Catch::Contains("error"));
}
