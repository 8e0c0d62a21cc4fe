// Follower of prescribed motion: vertices are exactly at their targets at the end of a step, along
// linear trajectories or by Dirichlet continuation.
#include "framework/stepping/prescribed_motion_follower.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/contact/contact_system.hpp"
#include "geometry/exact/intersections.hpp"
#include "tests/support/step_problem.hpp"

using namespace tack;

namespace {

// A plate that moves in a step of 10 ms by `motion`, and a block above it at a height.
std::string scene(const std::string& motion, double height, const std::string& block = "energies: [{type: neo_hookean, young: 1e5, density: 1000}]") {
  return fmt::format("time: {{step: 0.01, duration: 1}}\n"
                     "objects:\n"
                     "  - {{name: plate, shape: {{type: box, size: [0.1, 0.01, 0.1]}}, motion: [{}]}}\n"
                     "  - {{name: block, shape: {{type: box, size: [0.05, 0.05, 0.05]}}, place: {{translate: [0, {}, 0]}}, {}}}\n"
                     "  - {{name: bystander, shape: {{type: box, size: [0.01, 0.01, 0.01]}}, place: {{translate: [0, 5, 0]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n"
                     "contact: {{distance: 1 mm}}\n",
                     motion, 0.03 + height, block);
}
std::string rises(double metres) { return fmt::format("{{type: translate, velocity: [0, {}, 0]}}", metres / 0.01); }

struct Follow : StepProblem {
  explicit Follow(const std::string& yaml) : StepProblem(yaml), follower(*world, *solver, clock, steps) {
    steps.observe([this](const VecX&, const VecX&, double feasible) { tried.push_back(feasible); });
    result = follower.follow(step, nullptr, {});
  }
  bool intersects() const { return !find_intersections(world->contact->surface().mesh, result.x, world->contact->colliding(), 1).empty(); }
  bool arrived() const {
    for (const int v : step.fixed.vertices())
      if (Vec3(vertex(result.x, v)) != Vec3(vertex(step.targets, v))) return false;
    return true;
  }
  double displacement(int body) const {  // largest of its vertices [m]
    double largest = 0;
    for (const int v : world->vertices_of(body)) largest = std::max(largest, (vertex(result.x, v) - vertex(step.state.x, v)).norm());
    return largest;
  }

  PrescribedMotionFollower follower;
  std::vector<double> tried;
  DirichletContinuation::Result result;
};

}  // namespace

TEST_CASE("on a free linear trajectory targets are reached exactly without an iteration, and nothing else moves", "[stepping][follower]") {
  const Follow follow(scene(rises(0.02), 0.05));
  CHECK(follow.result.failure.empty());
  CHECK(follow.arrived());
  CHECK(follow.result.solve.iterations == 0);
  CHECK(follow.displacement(0) == Approx(0.02));
  CHECK(follow.displacement(1) == 0);
}

TEST_CASE("free vertices move as predicted if that lowers the potential", "[stepping][follower]") {
  const Follow follow(scene(rises(0.01), 0.05, "velocity: [0, 1, 0], energies: [{type: neo_hookean, young: 1e5, density: 1000}]"));
  CHECK(follow.arrived());
  CHECK(follow.result.solve.iterations == 0);
  CHECK(follow.displacement(1) == Approx(0.01));  // h v
  CHECK(follow.displacement(2) < 1e-12);
}

TEST_CASE("on a blocked trajectory the continuation pushes the obstacle out of the way", "[stepping][follower]") {
  const Follow follow(scene(rises(0.02), 0.005));
  CHECK(follow.result.failure.empty());
  CHECK(follow.arrived());
  CHECK_FALSE(follow.intersects());
  CHECK(follow.result.solve.iterations > 0);
  CHECK(follow.displacement(1) > 0.014);  // it was 5 mm away
  CHECK(follow.displacement(2) < 1e-6);
  CHECK_FALSE(follow.tried.empty());
}

TEST_CASE("a fixed obstacle is named by the failure, and nothing has passed through it", "[stepping][follower]") {
  const Follow follow(scene(rises(0.02), 0.005, "motion: [fixed]"));
  CHECK_THAT(follow.result.failure, Catch::Contains("'plate'") && Catch::Contains("'block'"));
  CHECK_FALSE(follow.arrived());
  CHECK_FALSE(follow.intersects());
  CHECK(follow.displacement(0) < 0.005);
}

TEST_CASE("a half turn is made in substeps: it ends at its targets, and the body is not turned inside out", "[stepping][follower]") {
  const Follow follow(scene("{type: rotate, axis: [0, 1, 0], angular_velocity: 314.159265358979}", 0.05));
  CHECK(follow.arrived());
  CHECK(follow.result.solve.iterations == 0);
  for (const int v : follow.world->vertices_of(0)) {
    const Vec3 from = vertex(follow.step.state.x, v), to = vertex(follow.result.x, v);
    CHECK((to - Vec3(-from.x(), from.y(), -from.z())).norm() < 1e-9);
  }
}

TEST_CASE("an obstacle in the middle of a rotation blocks it, although both ends are free", "[stepping][follower]") {
  // A bar of 0.2 m rotates by 180 degrees about its middle; the block stands beside it.
  const std::string bar = "time: {step: 0.01, duration: 1}\n"
                          "objects:\n"
                          "  - {name: plate, shape: {type: box, size: [0.2, 0.02, 0.02]}, motion: [{type: rotate, axis: [0, 1, 0], angular_velocity: 314.159265358979}]}\n"
                          "  - {name: block, shape: {type: box, size: [0.02, 0.02, 0.02]}, place: {translate: [0, 0, 0.06]}, motion: [fixed]}\n"
                          "  - {name: bystander, shape: {type: box, size: [0.01, 0.01, 0.01]}, place: {translate: [0, 5, 0]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
                          "contact: {distance: 1 mm}\n";
  const Follow follow(bar);
  CHECK_FALSE(follow.result.failure.empty());
  CHECK_FALSE(follow.intersects());
}
