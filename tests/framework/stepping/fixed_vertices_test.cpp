#include "framework/stepping/fixed_vertices.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "framework/contact/contact_system.hpp"
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

TEST_CASE("candidates within a rigid group are searched only while self-pairs are enabled, those of other groups never") {
  TestRun run("time: {step: 0.01, duration: 1}\n"
                 "objects: [" + far + ", {name: sheet, shape: {type: box, size: [0.1, 0.01, 0.1], cells: [4, 1, 4]},\n"
                 "  motion: [{type: translate, velocity: [1, 0, 0]}]},\n"
                 " {name: grain, shape: {type: box, size: [0.1, 0.01, 0.1], cells: [4, 1, 4]}, place: {translate: [0, 5, 0]},\n"
                 "  body: {type: affine, density: 1000}}]\ncontact: {distance: 20 mm}\n");
  ContactSystem& contact = *run.world->contact;
  contact.cover(run.world->rest, VecX());
  const size_t none = contact.candidates().size();  // but within the far one
  const int sheet = run.world->bodies[1].first_vertex, grain = run.world->bodies[2].first_vertex;
  contact.enable_self_pairs({sheet});
  contact.cover(run.world->rest, VecX());
  const size_t in_sheet = contact.candidates().size();
  CHECK(in_sheet > none + 100);
  CHECK(std::none_of(contact.candidates().edge_edge.begin(), contact.candidates().edge_edge.end(),
                     [&](const auto& pair) { return contact.surface().mesh.edges[pair[0]][0] >= grain; }));
  contact.enable_self_pairs({sheet, grain});
  contact.cover(run.world->rest, VecX());
  CHECK(contact.candidates().size() > in_sheet + 100);
  contact.enable_self_pairs({});
  contact.cover(run.world->rest, VecX());
  CHECK(contact.candidates().size() == none);
}
