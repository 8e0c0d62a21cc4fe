#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::string scene(const std::string& motion, const std::string& more = "", const std::string& integrator = "quasi_static") {
  return fmt::format("time: {{step: 10 ms, duration: 1, integrator: {}}}\nsolver: {{type: projected_newton, tolerance: 1e-8, linear: cholmod}}\nobjects:\n"
                     "  - name: block\n    shape: {{type: box, size: [0.2, 0.1, 0.1], cells: [4, 2, 2]}}\n"
                     "    energies: [{{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}}]\n"
                     "    motion: [{}]\n{}", integrator, motion, more);
}
std::string face(const std::string& direction) { return "select: {type: face, direction: " + direction + "}"; }

}  // namespace

TEST_CASE("three planes of symmetry: uniaxial tension, exactly", "[fixed]") {
  // At a strain of 0.1% on rollers the stress is E e, and the sides contract by nu e.
  TestRun run(scene("{type: fixed, along: [1, 0, 0], " + face("[-1, 0, 0]") + "}, {type: fixed, along: [0, 1, 0], " + face("[0, -1, 0]") +
                        "}, {type: fixed, along: [0, 0, 1], " + face("[0, 0, -1]") +
                        "}, {type: translate, along: [1, 0, 0], velocity: [0.02, 7, 7], " + face("[1, 0, 0]") + "}",
                    "probes: [{name: pull, type: reaction, object: block, " + face("[1, 0, 0]") + "}]\n"));
  run.step();
  const double strain = 0.02 * 0.01 / 0.2;
  double x = 0, y = 0;
  for (int v = 0; v < run.world->mesh_vertex_count(); ++v) {
    const Vec3 u = run.at(v) - run.rest(v);
    x = std::max(x, std::abs(u.x() - strain * (run.rest(v).x() + 0.1)));
    y = std::max(y, std::abs(u.y() + 0.3 * strain * (run.rest(v).y() + 0.05)));
  }
  CHECK(x < 1e-7);
  CHECK(y < 1e-7);
  const std::vector<double> reaction = run.sample(0);
  CHECK(reaction[0] == Approx(1e5 * strain * 0.01).epsilon(2e-3));
  CHECK(std::abs(reaction[1]) < 1e-6);
}

TEST_CASE("a block in free fall on an inclined guide slides along it", "[fixed]") {
  TestRun run(scene("{type: fixed, across: [1, -1, 0]}", "gravity: [0, -10, 0]\n", "newmark"));
  for (int i = 0; i < 20; ++i) run.step();
  const double t = run.state().time, distance = 10 / std::sqrt(2.0) * t * t / 2;
  for (const int v : {0, 20, 44})
    CHECK((run.at(v) - run.rest(v) - distance / std::sqrt(2.0) * Vec3(1, -1, 0)).norm() < 1e-6);
}

TEST_CASE("an affine body on a guide, and one pushed by a prescribed plate that slides freely", "[fixed]") {
  TestRun run("time: {step: 5 ms, duration: 1}\ngravity: [0, -10, 0]\nobjects:\n"
              "  - {name: bead, shape: {type: box, size: [0.1, 0.1, 0.1]}, body: affine, motion: [{type: fixed, across: [0, 1, 0]}]}\n");
  for (int i = 0; i < 20; ++i) run.step();
  const Vec3 c = run.world->centre_of_mass(0, run.state().x);
  CHECK(c.y() == Approx(-10 * 0.1 * 0.105 / 2).epsilon(1e-3));
  CHECK(std::hypot(c.x(), c.z()) < 1e-12);
}

TEST_CASE("a roller that is driven into an obstacle pushes it", "[fixed]") {
  TestRun run("time: {step: 10 ms, duration: 1}\nobjects:\n"
              "  - {name: pad, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, energies: [{type: neo_hookean, young: 1e5, density: 1000}], "
              "motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}\n"
              "  - {name: press, shape: {type: box, size: [0.2, 0.1, 0.2]}, place: {translate: [0, 0.102, 0]}, energies: [{type: neo_hookean, young: 1e6, density: 1000}], "
              "motion: [{type: translate, along: [0, 1, 0], velocity: [0, -0.5, 0], select: {type: face, direction: [0, 1, 0]}}]}\n"
              "contact: {distance: 1 mm}\n");
  for (int i = 0; i < 4; ++i) run.step();
  double top = 1;
  for (int v = run.world->bodies[1].first_vertex; v < run.world->mesh_vertex_count(); ++v)
    if (run.rest(v).y() > 0.15) top = std::min(top, run.at(v).y());
  CHECK(top == Approx(0.152 - 0.02).epsilon(1e-9));
}

TEST_CASE("contradicting motions of single directions are refused") {
  CHECK_THROWS_WITH(TestScene(scene("{type: fixed, along: [1, 0, 0]}, {type: fixed, along: [1, 1, 0]}")), Contains("not at right angles"));
  CHECK_THROWS_WITH(TestScene(scene("{type: fixed, along: [1, 0, 0], across: [0, 1, 0]}")), Contains("either along or across"));
  CHECK_THROWS_WITH(TestScene(scene("{type: fixed, along: [0, 0, 0]}")), Contains("must not be zero"));
  CHECK_THROWS_WITH(TestScene("time: {step: 1 ms, duration: 1}\nobjects: [{name: a, shape: {type: box, size: [1, 1, 1], cells: [2, 1, 1]}, body: affine, "
                              "motion: [{type: fixed, along: [1, 0, 0], select: {type: box, min: [-1, -1, -1], max: [0, 1, 1]}}]}]\n"),
                    Contains("some vertices of an affine body"));
}
