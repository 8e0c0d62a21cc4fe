// The penalty of prescribed motion that meets obstacles: its rule, and its two parameters.
#include "framework/stepping/penalty_rule.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/test_run.hpp"

using namespace tack;

TEST_CASE("the penalty grows tenfold unless a minimisation halves the distance", "[prescribed_motion]") {
  PenaltyRule rule(2, 1, 0.01);
  CHECK(rule.next(0.51) == 10);
  CHECK(rule.stiffness() == 20);
  CHECK(rule.next(0.25) == 1);
  CHECK(rule.stiffness() == 20);
  CHECK(rule.next(0.2) == 10);
}

TEST_CASE("targets are reached within the remainder, and closer if they could not be set", "[prescribed_motion]") {
  PenaltyRule rule(1, 3, 0.01);
  CHECK(rule.reached(0.0299));
  CHECK_FALSE(rule.reached(0.0301));
  rule.come_closer(0.02);
  CHECK(rule.reached(0.01));
  CHECK_FALSE(rule.reached(0.0101));
}

TEST_CASE("a minimisation of the penalty ends at the targets, or where the distance will not halve", "[prescribed_motion]") {
  PenaltyRule rule(1, 1, 0.01);
  CHECK(rule.norm(0.02, 1) == Approx(2));
  CHECK(rule.norm(0.5, 0.1) == Approx(0.4));
}

TEST_CASE("a prescribed motion is blocked after 30 iterations without 1% of progress, or at 1e8 times the first penalty", "[prescribed_motion]") {
  const auto iterations = [](double factor) {
    PenaltyRule rule(1, 1, 0.01);
    double distance = 1;
    int count = 0;
    for (; !rule.blocked() && count < 200; ++count) rule.norm(distance *= factor, 1);
    return count;
  };
  CHECK(iterations(1) == 31);
  CHECK(iterations(0.9999) == 31);  // 0.3% in all
  CHECK(iterations(0.98) == 200);
  PenaltyRule stiffer(1, 1, 0.01);
  int grown = 0;
  for (; !stiffer.blocked(); ++grown) CHECK(stiffer.next(1) == 10);
  CHECK(grown == 9);
  // A larger penalty counts as progress.
  PenaltyRule rule(1, 1, 0.01);
  for (int i = 0; i < 25; ++i) rule.norm(1, 1);
  rule.next(1);
  for (int i = 0; i < 29; ++i) rule.norm(1, 1);
  CHECK_FALSE(rule.blocked());
}

TEST_CASE("prescribed motion comes as close to its targets as its penalty and its remainder say", "[prescribed_motion]") {
  // A plate pushes a block. Returns the iterations, and the displacement by which the targets are set in the end, over that of the step.
  const auto push = [](const std::string& parameters) {
    TestRun run(fmt::format(
        "time: {{step: 0.1, duration: 1, integrator: quasi_static, stepper: {{type: incremental_potential{}}}}}\n"
        "solver: {{type: projected_newton, linear: cholmod, tolerance: 1e-4}}\n"
        "objects:\n"
        "  - {{name: plate, shape: {{type: box, size: [0.02, 0.2, 0.2]}}, place: {{translate: [-0.0155, 0, 0]}}, motion: [{{type: translate, velocity: [0.1, 0, 0]}}]}}\n"
        "  - {{name: block, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}, place: {{translate: [0.05, 0, 0]}},\n"
        "     motion: [{{type: fixed, select: {{type: face, direction: [1, 0, 0]}}}}], energies: [{{type: neo_hookean, young: 1e5, poisson: 0, density: 1000}}]}}\n"
        "contact: {{distance: 1 mm}}\n", parameters));
    int iterations = 0;
    double last = 0;
    StepObservers observers;
    observers.motion = [&](int, double, double, double) { ++iterations; };
    observers.steps = [&](const VecX&, const VecX& p, double) {
      if (p.size() == run.state().x.size() && p(0) > 0) last = p(0);  // vertex 0 belongs to the plate
    };
    run.simulation.observe(observers);
    run.simulation.start();
    run.step();
    CHECK(run.at(0).x() - run.rest(0).x() == Approx(0.01).epsilon(1e-12));
    return std::pair(iterations, last / 0.01);
  };
  const auto [usual, usual_last] = push("");
  const auto [soft, soft_last] = push(", prescribed_motion: {stiffness: 10}");
  const auto [near, near_last] = push(", prescribed_motion: {remainder: 1e-5}");
  INFO(usual << " " << usual_last << ", " << soft << " " << soft_last << ", " << near << " " << near_last);
  // By the defaults, 1000 and 0.01, a penalty of a thousand times the block's stiffness suffices without multipliers.
  CHECK(usual_last > 2e-4);
  CHECK(usual_last < 1e-3);
  CHECK(soft_last > 2 * usual_last);
  CHECK(soft_last <= 0.01);
  CHECK(near > usual);
  CHECK(near_last <= 1e-5);
}
