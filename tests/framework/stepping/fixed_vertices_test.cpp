#include "framework/stepping/fixed_vertices.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A free body far from all others.
const std::string far = "{name: far, shape: {type: box, size: [0.01, 0.01, 0.01]}, place: {translate: [0, 0, 9]}, "
                        "energies: [{type: neo_hookean, young: 1e5}]}";

}  // namespace

TEST_CASE("a half turn in one step is made in substeps that push obstacles") {
  const auto substeps = [](const std::string& motion) {
    TestScene scene("time: {step: 0.01, duration: 1}\nobjects: [" + far +
                    ", {name: bar, shape: {type: box, size: [0.2, 0.02, 0.02], cells: [4, 1, 1]}, motion: [" +
                    motion + "]}]\n");
    FixedVertices fixed(scene.world->prescribed_motion, scene.world->constraints, scene.world->rest);
    REQUIRE(fixed.activate(scene.world->start, 0.005));
    return fixed.rotation_substeps(0, 0.01);
  };
  const auto turn = [&](double degrees) {
    return substeps(fmt::format("{{type: rotate, axis: [0, 0, 1], angular_velocity: {}}}", degrees / 180 * M_PI / 0.01));
  };
  CHECK(substeps("fixed") == 1);
  CHECK(substeps("{type: translate, velocity: [100, 0, 0]}") == 1);
  CHECK(turn(10) == 1);
  CHECK(turn(89) == 1);
  CHECK(turn(100) == 2);
  CHECK(turn(180) == 2);
  CHECK(turn(360) == 1);
  CHECK(turn(540) == 2);  // three quarter turns each, with the linear trajectories of a quarter turn back
  CHECK(substeps("{type: formula, x: '-200 * X * t'}") == 1);  // not rigid
}

TEST_CASE("a paddle that rotates by 135 degrees in a step hits obstacles") {
  TestRun run("time: {step: 0.01, duration: 1}\n"
                 "objects:\n"
                 "  - {name: paddle, shape: {type: box, size: [0.2, 0.01, 0.1], cells: [4, 1, 2]},\n"
                 "     motion: [{type: rotate, axis: [0, 0, 1], angular_velocity: 235.619449019234}]}\n"
                 "  - {name: block, shape: {type: box, size: [0.03, 0.03, 0.03]}, place: {translate: [0.045, 0.025, 0]},\n"
                 "     energies: [{type: neo_hookean, young: 1e6}]}\n"
                 "contact: {distance: 1 mm}\n");
  run.step();
  const int first = run.world->bodies[1].first_vertex;
  CHECK(vertex(run.state().v, first).norm() > 0.5);  // m/s; zero if the paddle passed through
}
