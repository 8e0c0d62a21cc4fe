#include <catch2/catch.hpp>

#include "framework/checks/derivative_check.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;
using Catch::Contains;

namespace {

const std::string header = "time: {step: 2 ms, duration: 1}\ngravity: [0, -9.81, 0]\nsolver: {type: projected_newton, tolerance: 1e-8, linear: cholmod}\nobjects:\n";
const std::string material = "energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}]";
const std::string fixed_end = "motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}]";

std::string beam(const std::string& name, double length, int cells, double x, const std::string& more) {
  return "  - {name: " + name + ", shape: {type: box, size: [" + std::to_string(length) + ", 0.1, 0.1], cells: [" +
         std::to_string(cells) + ", 2, 2]}, place: {translate: [" + std::to_string(x) + ", 0, 0]}, " + material +
         (more.empty() ? "" : ", ") + more + "}\n";
}

int nearest(const TestRun& run, const Vec3& point) {
  int best = 0;
  for (int v = 0; v < run.world->mesh_vertex_count(); ++v)
    if ((run.rest(v) - point).norm() < (run.rest(best) - point).norm()) best = v;
  return best;
}

}  // namespace

TEST_CASE("two attached boxes move as one mesh", "[attach]") {
  TestRun one(header + beam("beam", 0.4, 4, 0.2, fixed_end));
  TestRun two(header + beam("left", 0.2, 2, 0.1, fixed_end) +
              beam("right", 0.2, 2, 0.3, "attach: [{select: {type: face, direction: [-1, 0, 0]}, to: left}]"));
  CHECK(two.world->dofs.size() == one.world->dofs.size());
  for (int i = 0; i < 30; ++i) {
    one.step();
    two.step();
  }
  for (const Vec3& p : {Vec3(0.4, 0.05, 0.05), Vec3(0.3, -0.05, 0), Vec3(0.2, 0.05, -0.05)}) {
    const Vec3 a = one.at(nearest(one, p)), b = two.at(nearest(two, p));
    CHECK((a - p).norm() > 1e-3);
    CHECK((a - b).norm() < 1e-10);
  }
}

TEST_CASE("non-matching meshes are attached, with derivatives by the remaining unknowns", "[attach]") {
  const std::string right =
      "  - {name: right, shape: {type: box, size: [0.2, 0.06, 0.06], cells: [2, 3, 3]}, place: {translate: [0.3, 0.01, 0]}, " + material +
      ", attach: [{select: {type: face, direction: [-1, 0, 0]}, to: left}]}\n";
  TestScene scene(header + beam("left", 0.2, 2, 0.1, fixed_end) + right);
  for (const DerivativeCheck& c : check_derivatives(*scene.world, 2e-3, scene.clock)) {
    INFO(c.term);
    CHECK_FALSE(c.wrong());
  }
  TestRun run(header + beam("left", 0.2, 2, 0.1, fixed_end) + right);
  for (int i = 0; i < 20; ++i) run.step();
  const std::vector<int>& tied = run.world->dofs.dependents();
  CHECK(tied.size() == 16);
  // The vertices stay on the face of the left box.
  const int corner = nearest(run, {0.2, 0.0, 0.0});
  CHECK(run.rest(corner).y() == Approx(0).margin(1e-12));
  CHECK(run.at(corner).y() < -1e-4);
}

TEST_CASE("vertices attached to an affine body follow it, and are released with its velocity", "[attach]") {
  TestRun run("time: {step: 1 ms, duration: 1}\nobjects:\n"
              "  - {name: wheel, shape: {type: box, size: [0.2, 0.2, 0.2]}, body: affine, spin: [0, 0, 5]}\n"
              "  - {name: ball, shape: {type: box, size: [0.02, 0.02, 0.02]}, place: {translate: [0.11, 0, 0]}, energies: [{type: neo_hookean, young: 1e5, density: 100}],\n"
              "     attach: [{to: wheel, within: 3 cm, until: 50 ms}], spin: [0, 0, 5], velocity: [0, 0.55, 0]}\n");
  const int ball = run.world->bodies[1].first_vertex;
  const double distance = run.rest(ball).norm();
  for (int i = 0; i < 50; ++i) run.step();
  CHECK(run.at(ball).norm() == Approx(distance).epsilon(1e-3));
  const double angle = 5 * 0.05;
  CHECK((run.at(ball) - Vec3(run.rest(ball).x() * std::cos(angle) - run.rest(ball).y() * std::sin(angle),
                             run.rest(ball).x() * std::sin(angle) + run.rest(ball).y() * std::cos(angle), run.rest(ball).z()))
            .norm() < 0.02 * distance);
  const int unknowns = run.world->dofs.size();
  const Vec3 v = run.world->centre_of_mass(1, run.state().v);
  CHECK(v.norm() == Approx(0.55).epsilon(0.02));
  for (int i = 0; i < 50; ++i) run.step();
  CHECK(run.world->dofs.size() == unknowns + 24);
  CHECK((run.world->centre_of_mass(1, run.state().v) - v).norm() < 0.02 * v.norm());
}

TEST_CASE("an affine body that is attached to a soft one follows it", "[attach]") {
  TestRun run(header + beam("left", 0.2, 2, 0.1, fixed_end) +
              "  - {name: stone, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0.25, 0, 0]}, body: {type: affine, density: 3000}, "
              "attach: [{select: {type: face, direction: [-1, 0, 0]}, to: left}]}\n");
  const int tip = nearest(run, {0.2, 0.05, 0.05}), corner = run.world->bodies[1].first_vertex;
  CHECK(run.world->dofs.size() == 3 * 18 + 3);
  const double y = run.at(corner).y();
  for (int i = 0; i < 30; ++i) run.step();
  CHECK(run.at(corner).y() < y - 1e-3);
  CHECK(run.at(tip).y() < 0.05 - 1e-3);
}

TEST_CASE("impossible attachments are refused") {
  const auto error = [](const std::string& right, const std::string& left = "") {
    TestScene(header + beam("left", 0.2, 2, 0.1, left) + right);
  };
  CHECK_THROWS_WITH(error(beam("right", 0.2, 2, 0.31, "attach: [{select: {type: face, direction: [-1, 0, 0]}, to: left}]")),
                    Contains("attach 0 of 'right'") && Contains("0.01 m away from 'left'") && Contains("within"));
  CHECK_THROWS_WITH(error(beam("right", 0.2, 2, 0.3, "attach: [{to: lift}]")), Contains("'lift'") && Contains("left"));
  CHECK_THROWS_WITH(error(beam("right", 0.2, 2, 0.3, "attach: [{to: right}]")), Contains("itself"));
  CHECK_THROWS_WITH(error(beam("right", 0.2, 2, 0.3, "motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}], "
                                                     "attach: [{select: {type: face, direction: [-1, 0, 0]}, to: left}]")),
                    Contains("prescribed by a motion"));
  CHECK_THROWS_WITH(error(beam("right", 0.2, 2, 0.3, "attach: [{select: {type: face, direction: [-1, 0, 0]}, to: left}]"),
                          "attach: [{select: {type: face, direction: [1, 0, 0]}, to: right}]"),
                    Contains("circle"));
}
