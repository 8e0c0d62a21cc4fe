// Shape quality of elements after plastic flow.
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/checks/flow_quality.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "geometry/tets/mean_ratio.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A bar that is drawn out to `length` of 0.1 m, with free sides.
std::string drawn(double length, const std::string& elements, const std::string& material) {
  return "time: {step: 0.1, duration: 1, integrator: quasi_static}\n"
         "solver: {type: projected_newton, force_tolerance: 1e-8}\n"
         "objects: [{name: bar, shape: {type: box, size: [0.1, 0.05, 0.05], cells: [2, 1, 1]}, elements: " + elements + ",\n"
         "  energies: [{" + material + "}],\n"
         "  motion: [{type: fixed, along: [1, 0, 0], select: {type: face, direction: [-1, 0, 0]}},\n"
         "    {type: fixed, along: [0, 1, 0], select: {type: face, direction: [0, -1, 0]}},\n"
         "    {type: fixed, along: [0, 0, 1], select: {type: face, direction: [0, 0, -1]}},\n"
         "    {type: translate, along: [1, 0, 0], displacement: [" + std::to_string(length - 0.1) + ", 0, 0], duration: 1,\n"
         "     select: {type: face, direction: [1, 0, 0]}}]}]\n";
}

struct Drawn {
  std::optional<double> lowest;
  std::vector<Warning> poor;
  double expected = 1;  // over all tets of the mesh
};

Drawn draw(double length, const std::string& elements, const std::string& material) {
  TestScene scene(drawn(length, elements, material));
  FlowQuality quality(*scene.world);
  TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
  while (!stepper.finished()) {
    stepper.advance();
    quality.examine(stepper.state().x, stepper.state().time);
  }
  Drawn result{quality.lowest(), quality.warnings()};
  for (const Tet& tet : scene.world->tets) result.expected = std::min(result.expected, mean_ratio(tet, stepper.state().x) / mean_ratio(tet, scene.world->rest));
  return result;
}

const std::string plastic = "type: von_mises, young: 1e6, poisson: 0.3, yield_stress: 1e4, hardening: 1e3";

}  // namespace

TEST_CASE("the mean ratio of a tet is one if it is regular, whatever its size, and zero if it is flat", "[flow_quality]") {
  VecX x(12);
  x << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
  const double turned = mean_ratio({1, 0, 2, 3}, x), regular = mean_ratio({0, 1, 2, 3}, x);
  CHECK(std::max(regular, turned) == Approx(1).epsilon(1e-14));
  CHECK(std::min(regular, turned) == 0);  // inverted
  CHECK(std::max(mean_ratio({0, 1, 2, 3}, 1e-4 * x), mean_ratio({1, 0, 2, 3}, 1e-4 * x)) == Approx(1).epsilon(1e-12));
  VecX flat = x;
  for (int v = 0; v < 4; ++v) flat(3 * v + 2) = 0;
  CHECK(mean_ratio({0, 1, 2, 3}, flat) == 0);
}

TEST_CASE("the lowest quality is over tets that have flowed, and a poor one is warned of", "[flow_quality]") {
  for (const std::string elements : {"linear", "composite", "patches"}) {
    INFO(elements);
    const Drawn little = draw(0.13, elements, plastic);
    REQUIRE(little.lowest);
    CHECK(*little.lowest > 0.5);
    CHECK(little.poor.empty());
    const Drawn much = draw(1.2, elements, plastic);
    REQUIRE(much.lowest);
    CHECK(*much.lowest == Approx(much.expected).epsilon(1e-12));
    CHECK(*much.lowest < 0.1);
    CHECK_THAT(only_text(much.poor, WarningKind::flattened_elements), Catch::Contains("object 'bar'") && Catch::Contains("finer cells"));
  }
}

TEST_CASE("a body that does not flow has no quality", "[flow_quality]") {
  CHECK_FALSE(draw(0.2, "linear", "type: neo_hookean, young: 1e6").lowest);
  CHECK_FALSE(draw(0.101, "linear", plastic).lowest);  // hardly flows
}
