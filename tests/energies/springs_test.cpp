#include <catch2/catch.hpp>

#include "energies/interactions/spring_term.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;
using Catch::Contains;

namespace {

// A block of 1 kg on a spring, drawn down by a hook that moves.
std::string pulled(const std::string& spring, const std::string& time = "time: {step: 5 ms, duration: 1}") {
  return time + "\nsolver: {type: projected_newton, tolerance: 1e-7}\nobjects:\n"
         "  - {name: ceiling, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 1, 0]}, motion: [fixed]}\n"
         "  - {name: hook, shape: {type: box, size: [0.1, 0.1, 0.1]}, motion: [{type: translate, velocity: [0, -0.1, 0]}]}\n"
         "  - {name: far, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [9, 0, 0]}, body: affine}\n"
         "interactions: [" + spring + "]\n";
}
const std::string chain =
    "{type: spring, name: link, from: {object: hook, select: {type: box, min: [-1, 0, -1], max: [0, 1, 0]}}, to: {object: ceiling}, stiffness: 1000, breaking_force: 25}";

}  // namespace

TEST_CASE("springs: derivatives are those of the value, also of those that are compressed or without a length", "[springs]") {
  SpringTerm term("s");
  term.add({0, 1}, {100, 0.5});
  term.add({1, 2}, {70, 3});
  term.add({0, 2}, {50, 0});
  VecX x(9);
  x << 0, 0.1, 0, 1, 0.2, -0.3, 0.4, 1.5, 0.2;
  const VecX slopes = gradient_by_differences([&](const VecX& y) { return term.value(y); }, x, 1e-4);
  CHECK((slopes - dense_gradient(term, x)).norm() <= 1e-9 * slopes.norm());
  const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(term, y); }, x, 1e-4);
  CHECK((curvatures - dense_hessian(term, x, Projection::none)).norm() <= 1e-9 * curvatures.norm());
  const MatX clamped = dense_hessian(term, x, Projection::clamp);
  CHECK(smallest_eigenvalue(clamped) >= -1e-10 * clamped.norm());
  VecX met = VecX::Zero(9);
  CHECK(dense_hessian(term, met, Projection::clamp).allFinite());
}

TEST_CASE("a spring breaks at its force, and stays broken", "[springs]") {
  TestRun run(pulled(chain));
  REQUIRE(run.world->interactions.size() == 1);
  const auto& springs = dynamic_cast<const SpringTerm&>(*run.world->interactions[0].terms.at(0));
  CHECK(springs.count() == 1);
  double largest = 0, dissipated = 0;
  while (springs.intact() > 0 && run.state().time < 0.9) {
    const StepReport report = run.step();
    dissipated += report.flows.of("dissipated_plastic");
    if (springs.intact() > 0) largest = springs.force(run.state().x).norm();
  }
  // 1000 N/m at 0.1 m/s: half a newton a step.
  CHECK(run.state().time == Approx(0.25).margin(0.006));
  CHECK(largest == Approx(25).epsilon(0.025));
  CHECK(dissipated == Approx(25.0 * 25 / 2000).epsilon(0.05));
  CHECK(springs.force(run.state().x).norm() == 0);
  run.step();
  CHECK(springs.intact() == 0);
}

TEST_CASE("impossible springs are refused") {
  const auto error = [](const std::string& spring) { TestScene{pulled(spring)}; };
  CHECK_THROWS_WITH(TestScene("springs: []\n"), "test.yaml:2:10: springs are interactions: write `interactions: [{type: spring, ...}]`, with the same keys");
  CHECK_THROWS_WITH(error("{type: spring, name: a, from: {object: hock}, to: {object: ceiling}, stiffness: 1}"), Contains("'hock'") && Contains("hook"));
  CHECK_THROWS_WITH(error("{type: spring, name: a, from: {object: hook}, to: {object: hook}, stiffness: 1}"), Contains("to itself"));
  CHECK_THROWS_WITH(error("{type: spring, name: a, from: {object: hook}, to: {object: ceiling}, stiffness: 1}, {type: spring, name: a, from: {object: hook}, to: {object: ceiling}, stiffness: 1}"),
                    Contains("two interactions are named"));
}
