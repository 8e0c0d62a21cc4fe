// Feasible step sizes: closed forms of approaching plates and flattened tets, and what observers
// and messages receive.
#include "framework/stepping/feasible_steps.hpp"

#include <catch2/catch.hpp>

#include "tests/framework/stepping/hand_made_world.hpp"

using namespace tack;

namespace {

constexpr double gap = 0.1;  // m

// Two squares, one above the other.
struct Plates : HandMadeWorld {
  explicit Plates(const CollidingObjects& colliding = CollidingObjects()) : HandMadeWorld(builder(), 0.05, colliding) {}
  static SurfaceBuilder builder() {
    SurfaceBuilder b;
    b.add_rectangle({2, 3}, 0, {0, 0, 0}, 1, 1);
    b.add_rectangle({3, 2}, 1, {0.1, 0.1, gap}, 1, 1, false);
    return b;
  }
  // The upper one moves.
  VecX motion(const Vec3& by) const {
    VecX p = VecX::Zero(world.rest.size());
    for (int v = world.bodies[1].first_vertex; v < world.rest.size() / 3; ++v) vertex(p, v) = by;
    return p;
  }
  const VecX& x() const { return world.rest; }
};

}  // namespace

TEST_CASE("pins the fraction of a gap that a step of any length may use: nine tenths", "[stepping][feasible]") {
  Plates plates;
  FeasibleSteps steps(plates.world, plates.clock);
  for (const double factor : {1.2, 2.0, 10.0, 1000.0}) {
    const double t = steps.largest(plates.x(), plates.motion({0, 0, -factor * gap}));
    INFO(factor);
    CHECK(t * factor <= 0.9 * (1 + 1e-9));
    CHECK(t * factor > 0.9 * 0.97);
  }
}

TEST_CASE("full steps that separate, slide or end before the obstacle are feasible", "[stepping][feasible]") {
  Plates plates;
  FeasibleSteps steps(plates.world, plates.clock);
  for (const Vec3& by : {Vec3(0, 0, 0), Vec3(0, 0, 5), Vec3(0.2, 0.1, 0), Vec3(0, 0, -0.5 * gap), Vec3(3, 0, 0)}) CHECK(steps.largest(plates.x(), plates.motion(by)) == 1);
}

TEST_CASE("plates that do not collide bound no step", "[stepping][feasible]") {
  CollidingObjects colliding;
  colliding.set(0, 1, false);
  Plates plates(colliding);
  FeasibleSteps steps(plates.world, plates.clock);
  CHECK(steps.largest(plates.x(), plates.motion({0, 0, -10 * gap})) == 1);
  CHECK(steps.blocker().empty());
}

TEST_CASE("pins the fraction of the volume of a tet that a step leaves: a fifth", "[stepping][feasible]") {
  Plates plates;
  // The apex is a vertex of the upper plate, high above the base: its height, and so its volume, falls linearly.
  plates.world.tets = {{0, 1, 3, plates.world.bodies[1].first_vertex}};
  FeasibleSteps steps(plates.world, plates.clock);
  VecX x = plates.x(), p = VecX::Zero(x.size());
  const int apex = plates.world.tets[0][3];
  vertex(x, apex) = Vec3(0.1, 0.1, 3);
  vertex(p, apex) = Vec3(0, 0, -2.9);
  const double t = steps.largest(x, p);
  CHECK(t * 2.9 / 3 <= 0.8 * (1 + 1e-9));
  CHECK(t * 2.9 / 3 > 0.8 * (1 - 1e-3));
}

TEST_CASE("the feasible step is the smallest of those of all filters", "[stepping][feasible]") {
  Plates plates;
  const VecX p = plates.motion({0, 0, -2 * gap});
  const double by_contact = FeasibleSteps(plates.world, plates.clock).largest(plates.x(), p);
  plates.world.tets = {{0, 1, 3, plates.world.bodies[1].first_vertex}};  // its height is the gap
  const double both = FeasibleSteps(plates.world, plates.clock).largest(plates.x(), p);
  CHECK(both < by_contact);
  CHECK(both == Approx(0.4).epsilon(1e-3));
  // A tall tet bounds less than contact does.
  VecX x = plates.x();
  vertex(x, plates.world.tets[0][3]).z() = 3;
  const double tall = FeasibleSteps(plates.world, plates.clock).largest(x, p);
  CHECK(tall < 0.5);
  plates.world.tets.clear();
  CHECK(tall == FeasibleSteps(plates.world, plates.clock).largest(x, p));
}

TEST_CASE("the observer is notified of steps that a minimiser requests, and of no others", "[stepping][feasible]") {
  Plates plates;
  FeasibleSteps steps(plates.world, plates.clock);
  std::vector<double> observed;
  VecX from, by;
  steps.observe([&](const VecX& x, const VecX& p, double feasible) {
    from = x;
    by = p;
    observed.push_back(feasible);
  });
  const VecX p = plates.motion({0, 0, -2 * gap});
  const double t = steps.largest(plates.x(), p);
  CHECK(observed.empty());
  CHECK(steps.largest_requested(plates.x(), p) == t);
  CHECK(steps.largest_requested(plates.x(), 0.1 * p) == 1);
  REQUIRE(observed.size() == 2);
  CHECK(observed[0] == t);
  CHECK(observed[1] == 1);
  CHECK(from == plates.x());
  CHECK(by == VecX(0.1 * p));
}

TEST_CASE("the blocker is that of the last requested step, until it is reset", "[stepping][feasible]") {
  Plates plates;
  FeasibleSteps steps(plates.world, plates.clock);
  CHECK(steps.blocker().empty());
  steps.largest(plates.x(), plates.motion({0, 0, -2 * gap}));
  CHECK(steps.blocker().empty());
  steps.largest_requested(plates.x(), plates.motion({0, 0, -2 * gap}));
  CHECK_THAT(steps.blocker(), Catch::StartsWith("; the last step was cut to 0.4") && Catch::Contains("'a'") && Catch::Contains("'b'") && Catch::Contains("0.1 m apart"));
  steps.largest_requested(plates.x(), plates.motion({0, 0, 1}));
  CHECK(steps.blocker().empty());
  steps.largest_requested(plates.x(), plates.motion({0, 0, -2 * gap}));
  steps.reset();
  CHECK(steps.blocker().empty());
}

TEST_CASE("a passed deadline ends the search for a feasible step", "[stepping][feasible]") {
  Plates plates;
  FeasibleSteps steps(plates.world, plates.clock);
  plates.clock.deadline().limit_run(Deadline::Clock::now(), 0);
  CHECK_THROWS_AS(steps.largest(plates.x(), plates.motion({0, 0, -1})), OutOfTime);
}
