#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/checks/derivative_check.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::string box(const std::string& more, const std::string& integrator = "newmark", double h = 1e-3) {
  return fmt::format("time: {{step: {}, duration: 10, integrator: {}}}\nsolver: {{type: projected_newton, tolerance: 1e-7}}\n"
                     "objects:\n  - name: box\n    shape: {{type: box, size: [0.1, 0.2, 0.3], cells: [2, 2, 2]}}\n"
                     "    body: affine\n{}", h, integrator, more);
}

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};
Momenta momenta(const TestRun& run) {
  Momenta m;
  for (int v = 0; v < static_cast<int>(run.world->mass.size()); ++v) {
    const Vec3 p = run.world->mass(v) * vertex(run.state().v, v);
    m.linear += p;
    m.angular += vertex(run.state().x, v).cross(p);
  }
  return m;
}

// Free rigid body with principal moments of inertia I, by Runge-Kutta steps of its quaternion and
// angular velocity.
struct RigidBody {
  Vec3 inertia, spin;  // about its own axes
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();

  void advance(double h) {
    const auto slope = [&](const Eigen::Quaterniond& q, const Vec3& w) {
      const Eigen::Quaterniond rate = q * Eigen::Quaterniond(0, w.x(), w.y(), w.z());
      const Vec3 w_dot = inertia.cwiseProduct(w).cross(w).cwiseQuotient(inertia);
      return std::pair{Eigen::Vector4d(0.5 * rate.coeffs()), w_dot};
    };
    const auto at = [&](const std::pair<Eigen::Vector4d, Vec3>& k, double t) {
      return std::pair{Eigen::Quaterniond(Eigen::Vector4d(turn.coeffs() + t * k.first)), Vec3(spin + t * k.second)};
    };
    const auto k1 = slope(turn, spin);
    const auto p2 = at(k1, h / 2);
    const auto k2 = slope(p2.first, p2.second);
    const auto p3 = at(k2, h / 2);
    const auto k3 = slope(p3.first, p3.second);
    const auto p4 = at(k3, h);
    const auto k4 = slope(p4.first, p4.second);
    turn.coeffs() += h / 6 * (k1.first + 2 * k2.first + 2 * k3.first + k4.first);
    turn.normalize();
    spin += h / 6 * (k1.second + 2 * k2.second + 2 * k3.second + k4.second);
  }
};

}  // namespace

TEST_CASE("strain of an affine body is warned of once", "[affine]") {
  TestRun run("time: {step: 1 ms, duration: 1}\nobjects:\n"
              "  - {name: box, shape: {type: box, size: [0.1, 0.1, 0.1]}, body: {type: affine, density: 1000, stiffness: 10 kPa},\n"
              "     loads: [{type: traction, value: [100, 0, 0], select: {type: face, direction: [1, 0, 0]}},\n"
              "       {type: traction, value: [-100, 0, 0], select: {type: face, direction: [-1, 0, 0]}}]}\n");
  for (int i = 0; i < 30; ++i) run.step();
  CHECK_THAT(only_text(run.warnings, WarningKind::affine_strain), Contains("body.stiffness"));
}

TEST_CASE("an affine body has twelve unknowns, and derivatives in them", "[affine]") {
  TestScene scene("time: {step: 1 ms, duration: 1}\ngravity: [0, -9.81, 0]\nobjects:\n"
                  "  - {name: floor, shape: {type: box, size: [1, 0.1, 1], cells: [4, 1, 4]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n"
                  "  - {name: one, shape: {type: box, size: [0.2, 0.1, 0.2], cells: [3, 2, 3]}, place: {translate: [0, 0.0507, 0]}, body: affine}\n"
                  "  - {name: two, shape: {type: box, size: [0.2, 0.1, 0.2], cells: [2, 1, 2]}, place: {translate: [0.05, 0.1514, 0.02]}, body: affine}\n"
                  "  - {name: soft, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0.05, 0.2521, 0.02]}, "
                  "energies: [{type: neo_hookean, young: 1e5}]}\n"
                  "contact: {distance: 1 mm, friction: {mu: 0.3}}\n");
  CHECK(scene.world->dofs.size() == 24 + 81);
  const auto checks = check_derivatives(*scene.world, 1e-3, scene.clock);
  REQUIRE(checks.size() == 5);
  for (const DerivativeCheck& c : checks) {
    INFO(c.term);
    CHECK(c.active());
    CHECK_FALSE(c.wrong());
  }
}

TEST_CASE("free flight of an affine body: parabola and conserved momenta", "[affine]") {
  TestRun run(box("    velocity: [1, 2, 0]\n    spin: [3, 5, -2]\ngravity: [0, -9.81, 0]\n"));
  const Momenta before = momenta(run);
  CHECK(before.linear.norm() == Approx(6 * std::sqrt(5.0)));
  for (int i = 0; i < 300; ++i) run.step();
  const double t = run.state().time;
  const Vec3 centre = run.world->centre_of_mass(0, run.state().x);
  CHECK((centre - Vec3(t, 2 * t - 9.81 / 2 * t * t, 0)).norm() < 1e-5);
  const Momenta after = momenta(run);
  const Vec3 expected = before.linear - Vec3(0, 6 * 9.81 * t, 0);
  CHECK((after.linear - expected).norm() < 1e-5 * expected.norm());
  const Vec3 about_centre = after.angular - centre.cross(after.linear);
  CHECK((about_centre - before.angular).norm() < 1e-3 * before.angular.norm());
}

TEST_CASE("a spinning affine body rotates as a rigid body", "[affine]") {
  // About the middle axis, which is unstable.
  TestRun run(box("    spin: [0.2, 20, 0.3]\n"));
  const Vec3 square(0.01, 0.04, 0.09);
  RigidBody rigid{Vec3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y()) * 6 / 12, Vec3(0.2, 20, 0.3)};
  double largest = 0;
  for (int i = 0; i < 400; ++i) {
    run.step();
    for (int k = 0; k < 10; ++k) rigid.advance(1e-4);
    for (const int v : {0, 7, 26}) largest = std::max(largest, (run.at(v) - rigid.turn * run.rest(v)).norm());
  }
  CHECK(largest < 0.01 * 0.187);  // of the distance of a corner from the centre
}

TEST_CASE("an affine body of a closed surface equals that of its tets", "[affine]") {
  const std::string text = "time: {step: 1 ms, duration: 1}\nobjects:\n  - {name: ball, shape: {type: box, size: [0.1, 0.2, 0.1], cells: [2, 3, 2]SURFACE}, body: {type: affine, density: 2000}}\n";
  const auto of = [&](const std::string& more) {
    std::string scene = text;
    return scene.replace(scene.find("SURFACE"), 7, more);
  };
  TestScene solid(of("")), surface(of(", surface: true"));
  CHECK(solid.world->dofs.size() == 12);
  CHECK(surface.world->dofs.size() == 12);
  CHECK(surface.world->mass.sum() == Approx(solid.world->mass.sum()).epsilon(1e-12));
  CHECK(surface.world->mass.sum() == Approx(4).epsilon(1e-12));
}

TEST_CASE("an affine body fixed on a line swings as a physical pendulum", "[affine]") {
  // It swings about its upper edge along z, half a diagonal of 0.1 m from the centre.
  TestRun run(box("    motion: [{type: fixed, select: {type: box, min: [0.04, 0.09, -1], max: [1, 1, 1]}}]\ngravity: [0, -9.81, 0]\n"));
  CHECK(run.world->dofs.size() == 6);
  const Vec3 pivot(0.05, 0.1, 0);
  const double arm = std::hypot(0.05, 0.1);
  const double inertia = (0.01 + 0.04) / 12 + arm * arm;  // by mass
  const double angle0 = std::atan2(0.05, 0.1);  // of the centre from below the pivot
  // Large angles: integrate the pendulum.
  double angle = angle0, rate = 0;
  while (run.state().time < 0.5 * (1 - 1e-9)) run.step();
  for (int k = 0; k < 50000; ++k) {
    rate -= 1e-5 * 9.81 * arm / inertia * std::sin(angle);
    angle += 1e-5 * rate;
  }
  const Vec3 from = run.world->centre_of_mass(0, run.state().x) - pivot;
  CHECK(from.norm() == Approx(arm).epsilon(1e-3));
  const double now = std::atan2(-from.x(), -from.y());
  CHECK(std::abs(now - angle) < 0.01 * angle0);
}

TEST_CASE("fixed vertices of an affine body make as many frame vertices dependent as they are independent", "[affine]") {
  const auto unknowns = [](const std::string& select) {
    return TestScene(box("    motion: [{type: fixed, select: " + select + "}]\n"
                         "  - {name: other, shape: {type: box, size: [1, 1, 1]}, place: {translate: [5, 0, 0]}, body: affine}\n"))
        .world->dofs.size();
  };
  CHECK(unknowns("{type: box, min: [0.04, 0.09, 0.14], max: [1, 1, 1]}") == 12 + 9);   // a corner
  CHECK(unknowns("{type: box, min: [0.04, 0.09, -1], max: [1, 1, 1]}") == 12 + 6);      // an edge
  CHECK(unknowns("{type: face, direction: [0, 1, 0]}") == 12 + 3);
  CHECK(unknowns("{type: box, min: [-1, -0.01, -1], max: [1, 1, 1]}") == 12);           // half of it
}

TEST_CASE("impossible affine bodies are refused") {
  const auto error = [](const std::string& object) {
    TestScene("time: {step: 1 ms, duration: 1}\nobjects: [" + object + "]\n");
  };
  CHECK_THROWS_WITH(error("{name: a, shape: {type: grid, size: [1, 1]}, body: affine}"), Contains("'a' (body: affine)") && Contains("not closed"));
  CHECK_THROWS_WITH(error("{name: a, shape: {type: box, size: [1, 1, 1]}, body: affine, energies: [{type: neo_hookean, young: 1e5}]}"),
                    Contains("has energies"));
  CHECK_THROWS_WITH(error("{name: a, shape: {type: box, size: [1, 1, 1], cells: [2, 1, 1]}, body: affine, loads: [{type: body_force, value: [1, 0, 0], "
                          "select: {type: box, min: [-1, -1, -1], max: [0, 1, 1]}}]}"), Contains("select all of it"));
}

TEST_CASE("a prescribed motion that would deform an affine body is refused") {
  TestRun run(box("    motion: [{type: formula, x: '0.1 * t * Y * Y', select: {type: box, min: [-1, -1, 0.14], max: [1, 1, 1]}}]\n"));
  CHECK_THROWS_WITH(run.step(), Contains("deform an affine body"));
}

TEST_CASE("loads on an affine body accelerate the body as a whole", "[affine]") {
  TestRun run(box("    loads: [{type: body_force, value: [2, 0, 0]}, {type: traction, value: [0, 300, 0], select: {type: face, direction: [0, -1, 0]}}]\n"));
  for (int i = 0; i < 100; ++i) run.step();
  // 300 Pa on 0.03 m^2 and 6 kg: 1.5 m/s^2.
  CHECK((run.world->centre_of_mass(0, run.state().v) - Vec3(0.2, 0.15, 0)).norm() < 1e-5);
}

TEST_CASE("a stiff grain that lands on its tip and rotates takes few iterations", "[affine]") {
  // It rotates by two radians in the step of the impact.
  TestRun run("time: {step: 10 ms, duration: 1}\ngravity: [0, -9.81, 0]\nobjects:\n"
              "  - {name: floor, shape: {type: box, size: [0.1, 0.01, 0.1]}, place: {translate: [0, -0.005, 0]}, motion: [fixed]}\n"
              "  - name: grain\n    shape: {type: sphere, radius: 2 mm, cells: 3, surface: true}\n"
              "    place: {scale: [2, 1, 1], axis: [0, 0, 1], angle: 50 deg, translate: [0, 6 mm, 0]}\n"
              "    velocity: [0, -0.4, 0]\n    body: {type: affine, density: 1200, stiffness: 1 GPa}\n"
              "contact: {distance: 0.4 mm, barrier: {stiffness: 200 kPa}, friction: {mu: 0.3, eps_v: 1 cm/s}}\n");
  int largest_iterations = 0;
  for (int i = 0; i < 10; ++i) {
    largest_iterations = std::max(largest_iterations, run.step().solve.iterations);
  }
  CHECK(largest_iterations < 40);
}
