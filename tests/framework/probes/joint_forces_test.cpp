// Probes of the forces of joints and of fixed vertices: statics with contact, and bodies that turn, with every integrator.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "tests/support/test_run.hpp"

using namespace tack;

TEST_CASE("joint forces between supported bodies of different mass agree with statics", "[probes]") {
  // Each bar is joined at its left end, at 0 m and 0.5 m, and rests with its right end on a support.
  constexpr double light = 0.98 * 0.05 * 0.05 * 1000 * 9.81, heavy = 4 * light;  // N
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
    INFO(integrator);
    TestRun run(fmt::format("time: {{step: 2 ms, duration: 1, integrator: {}}}\n", integrator) + R"(
gravity: [0, -9.81, 0]
objects:
  - {name: support, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [1.35, -0.0758, 0]}, motion: [fixed]}
  - {name: bar, shape: {type: box, size: [0.98, 0.05, 0.05], cells: [10, 1, 1]}, body: {type: affine, density: 1000}, damping: {mass: 100}}
  - {name: heavy, shape: {type: box, size: [0.98, 0.05, 0.05], cells: [10, 1, 1]}, place: {translate: [1, 0, 0]}, body: {type: affine, density: 4000}, damping: {mass: 100}}
interactions:
  - {type: weld, name: wall, object: bar, at: [-0.5, 0, 0]}
  - {type: hinge, name: elbow, object: heavy, to: bar, at: [0.5, 0, 0], axis: [0, 0, 1]}
contact: {distance: 1 mm, pairs: [{between: [bar, support], contact: false}]}
solver: {type: projected_newton, tolerance: 1e-7}
probes:
  - {name: wall, type: joint_force, interaction: wall, direction: [0, 1, 0]}
  - {name: elbow, type: joint_force, interaction: elbow, direction: [0, 1, 0]}
  - {name: support, type: contact_force, on: heavy, direction: [0, 1, 0]}
)");
    for (int i = 0; i < 200; ++i) run.step();
    const double wall = run.sample(0)[0], elbow = run.sample(1)[0], support = run.sample(2)[0];
    const double tolerance = integrator == "newmark" ? 0.02 : 1e-4;
    CHECK(elbow + support == Approx(heavy).epsilon(tolerance));
    CHECK(wall - elbow == Approx(light).epsilon(tolerance));
  }
}
