// Orders of convergence, free fall and conservation of each integrator.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/stepping/time_stepper.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

const std::vector<std::string> dynamic_integrators = {"implicit_euler", "bdf2", "newmark", "generalised_alpha", "sdirk2", "tr_bdf2"};

std::string scene_text(const std::string& integrator, double h, const std::string& more) {
  return fmt::format("time: {{step: {}, duration: 10, integrator: {}}}\n"
                     "solver: {{type: projected_newton, tolerance: 1e-9}}\n", h, integrator) + more;
}

// Returns the end of a run of n steps. `prepare` may change the start.
template <class Prepare>
State run(const std::string& yaml, int n, const Prepare& prepare) {
  TestScene scene(yaml);
  prepare(*scene.world);
  std::vector<Warning> warnings;
  TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock,
                      [&](const Warning& w) { warnings.push_back(w); });
  for (int i = 0; i < n; ++i) stepper.advance();
  CHECK(warnings.empty());
  return stepper.state();
}

// A block fixed at one face, with an initial velocity of small amplitude.
State oscillation(const std::string& integrator, int steps) {
  constexpr double duration = 0.02;  // s; a large fraction of the lowest period
  return run(scene_text(integrator, duration / steps,
                        "objects: [{name: block, shape: {type: box, size: [0.1, 0.1, 0.1]},\n"
                        "  energies: [{type: neo_hookean, young: 2e4}],\n"
                        "  motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}]\n"),
             steps, [](World& world) {
               for (int b = 0; b < world.dofs.block_count(); ++b)
                 vertex(world.start.v, world.dofs.vertex_of_block(b)) = Vec3(1e-3, 2e-4, 0);
             });
}

const char* const free_block =
    "objects: [{name: block, shape: {type: box, size: [0.1, 0.07, 0.05]}, velocity: [0.3, 0.1, -0.2],\n"
    "  energies: [{type: neo_hookean, young: 1e5}]}]\n";

// A stretched and spinning block without external forces.
void disturb(World& world) {
  for (int v = 0; v < world.rest.size() / 3; ++v) {
    const Vec3 x = vertex(world.rest, v);
    vertex(world.start.x, v) = Vec3(1.05 * x.x(), 0.98 * x.y(), x.z() + 0.03 * x.x());
    vertex(world.start.v, v) += Vec3(2, 5, -3).cross(x);
  }
}

Vec3 momentum(const World& world, const State& s) {
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < world.mass.size(); ++v) sum += world.mass(v) * vertex(s.v, v);
  return sum;
}
Vec3 angular_momentum(const World& world, const State& s) {
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < world.mass.size(); ++v)
    sum += world.mass(v) * Vec3(vertex(s.x, v)).cross(Vec3(vertex(s.v, v)));
  return sum;
}

}  // namespace

TEST_CASE("integrators converge with their order", "[stepping]") {
  const VecX reference = oscillation("newmark", 2000).x;
  const std::map<std::string, double> orders = {
      {"implicit_euler", 1}, {"bdf2", 2}, {"newmark", 2}, {"generalised_alpha", 2}, {"sdirk2", 2}, {"tr_bdf2", 2}};
  for (const auto& [name, order] : orders) {
    std::vector<double> errors;
    for (const int steps : {100, 200, 400}) errors.push_back((oscillation(name, steps).x - reference).norm());
    INFO(name << ": errors " << errors[0] << " " << errors[1] << " " << errors[2] << " m");
    CHECK(std::log2(errors[0] / errors[1]) == Approx(order).margin(0.2));
    CHECK(std::log2(errors[1] / errors[2]) == Approx(order).margin(0.2));
  }
}

// Under a constant acceleration g the minimiser is x~ + scale g, vertex by vertex.
TEST_CASE("free fall obeys the formula of each integrator", "[stepping]") {
  constexpr double h = 0.01;
  constexpr int n = 12;
  const Vec3 g(0.5, -9.81, 1), v0(0.3, 0.1, -0.2);
  const std::string fall = std::string("gravity: [0.5, -9.81, 1]\n") + free_block;
  const auto check = [&](const std::string& name, const Vec3& moved, const Vec3& velocity) {
    INFO(name);
    VecX rest;
    const State s = run(scene_text(name, h, fall), n, [&](World& world) { rest = world.rest; });
    for (int v = 0; v < rest.size() / 3; ++v) {
      CHECK((vertex(s.x, v) - vertex(rest, v) - moved).norm() <= 1e-9);
      CHECK((vertex(s.v, v) - velocity).norm() <= 1e-8);
    }
    CHECK(s.time == Approx(n * h).epsilon(1e-14));
    CHECK(s.step == n);
  };
  const double t = n * h;
  check("implicit_euler", t * v0 + h * h * n * (n + 1) / 2.0 * g, v0 + t * g);
  for (const char* name : {"newmark", "generalised_alpha", "sdirk2", "tr_bdf2"}) check(name, t * v0 + t * t / 2 * g, v0 + t * g);
  Vec3 x_before = Vec3::Zero(), v_before = v0, x = h * v0 + h * h * g, v = v0 + h * g;  // first step: Euler
  for (int i = 1; i < n; ++i) {
    const Vec3 next = (4 * x - x_before) / 3 + h * (8 * v - 2 * v_before) / 9 + 4 * h * h / 9 * g;
    v_before = std::exchange(v, (3 * next - 4 * x + x_before) / (2 * h));
    x_before = std::exchange(x, next);
  }
  check("bdf2", x, v);
}

TEST_CASE("momentum is conserved without forces from outside", "[stepping]") {
  for (const std::string& name : dynamic_integrators) {
    INFO(name);
    TestScene scene(scene_text(name, 1e-3, free_block));
    disturb(*scene.world);
    TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
    const Vec3 before = momentum(*scene.world, stepper.state());
    for (int i = 0; i < 50; ++i) stepper.advance();
    CHECK((momentum(*scene.world, stepper.state()) - before).norm() <= 1e-7 * before.norm());
  }
}

TEST_CASE("the drift of angular momentum shrinks with the order of the integrator", "[stepping]") {
  const auto drift = [](const std::string& name, int steps) {
    TestScene scene(scene_text(name, 0.02 / steps, free_block));
    disturb(*scene.world);
    TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
    const Vec3 before = angular_momentum(*scene.world, stepper.state());
    for (int i = 0; i < steps; ++i) stepper.advance();
    return (angular_momentum(*scene.world, stepper.state()) - before).norm() / before.norm();
  };
  CHECK(drift("implicit_euler", 100) < 0.1);
  CHECK(drift("implicit_euler", 100) / drift("implicit_euler", 200) > 1.6);
  for (const std::string name : {"bdf2", "newmark", "generalised_alpha", "tr_bdf2"}) {
    INFO(name);
    CHECK(drift(name, 200) < 5e-3);
    CHECK(drift(name, 200) / drift(name, 400) > 3);
  }
}
