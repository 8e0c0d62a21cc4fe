// Default tolerances, and warnings about tolerances that do not fit the scene.
#include "framework/experiment/tolerances.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/component_variants.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A cube of the given size above ground ten times as wide.
std::string cube(double size, double step, const std::string& more = "", const std::string& integrator = "implicit_euler") {
  return fmt::format("time: {{step: {}, duration: {}, integrator: {}}}\n"
                     "objects:\n"
                     "  - {{name: ground, shape: {{type: box, size: [{}, {}, {}]}}, motion: [fixed],\n"
                     "     place: {{translate: [0, {}, 0]}}}}\n"
                     "  - {{name: cube, shape: {{type: box, size: [{}, {}, {}]}}, place: {{translate: [0, {}, 0]}},\n"
                     "     energies: [{{type: neo_hookean, young: 1e5, density: 1000}}]}}\n{}",
                     step, step, integrator, 10 * size, size, 10 * size, -size, size, size, size, size, more);
}

double tolerance(const std::string& yaml) { return TestScene(yaml).config.solver->velocity_tolerance(); }

std::vector<Warning> warnings_of(const std::string& yaml) {
  TestScene scene(yaml);
  return tolerance_warnings(scene.config);
}

}  // namespace

TEST_CASE("the default tolerance is 1 cm/s where a metre is, and less where that means nothing", "[scene]") {
  CHECK(tolerance(cube(1, 0.01, "contact: {distance: 1 mm}\n")) == 0.01);
  CHECK(tolerance(cube(0.1, 0.001, "contact: {distance: 1 mm}\n")) == 0.01);
  CHECK(tolerance(cube(1, 0.01)) == 0.01);
  CHECK(tolerance(cube(1, 0.04, "contact: {distance: 1 mm}\n")) == Approx(0.0025));   // the step
  CHECK(tolerance(cube(1, 0.01, "contact: {distance: 1e-5}\n")) == Approx(1e-4));     // the contact
  CHECK(tolerance(cube(1, 0.01, "contact: {distance: 1 mm, friction: {mu: 0.3}}\n")) == 1e-3);                 // sticking
  CHECK(tolerance(cube(1, 0.01, "contact: {distance: 1 mm, friction: {mu: 0.3, eps_v: 5 cm/s}}\n")) == 0.01);
  CHECK(tolerance(cube(1, 0.01, "contact: {distance: 1 mm, friction: {mu: 0.3, eps_v: 1e-8}}\n")) == 1e-4);    // the smallest
  CHECK(warnings_of(cube(1, 0.01, "contact: {distance: 1 mm, friction: {mu: 0.3}}\n")).empty());
  CHECK(warnings_of(cube(1, 0.01, "contact: {distance: 1 mm, friction: {mu: 0.3, eps_v: 1e-8}}\n")).size() == 1);
  CHECK(tolerance(cube(1e-6, 0.01)) == Approx(std::sqrt(3.0) * 1e-7));                // the size
  CHECK(tolerance(cube(1e-6, 0.01, "solver: {type: lbfgs, tolerance: 0.01}\n")) == 0.01);  // a given tolerance stays
}

TEST_CASE("default tolerances become part of the scene", "[scene]") {
  TestScene scene(cube(1e-3, 0.01));
  const Value solver = to_value(scene.config.solver.get());
  REQUIRE(solver.find("tolerance"));
  const auto again = bind_component<Minimizer>(solver);
  CHECK(again->velocity_tolerance() == scene.config.solver->velocity_tolerance());
}

TEST_CASE("tolerances that do not fit contact or friction are warned of", "[scene]") {
  const std::string contact = "contact: {distance: 1 mm}\n";
  CHECK(warnings_of(cube(1, 0.01, contact)).empty());
  CHECK(warnings_of(cube(1, 0.04, contact)).empty());  // the default fits
  const auto coarse = warnings_of(cube(1, 0.04, contact + "solver: {type: lbfgs, tolerance: 1 cm/s}\n"));
  CHECK_THAT(only_text(coarse, WarningKind::solver_tolerance), Catch::Contains("contact distance is 0.001 m") && Catch::Contains("lower solver.tolerance to 0.0025 m/s"));

  const std::string friction =
      "contact:\n  friction: {mu: 0.5, eps_v: 2 cm/s}\n"
      "  pairs: [{between: [cube, ground], friction: {mu: 0.1, eps_v: 1 mm/s}}]\n";
  CHECK(warnings_of(cube(1, 0.01, friction)).empty());  // the default fits
  const auto creeping = warnings_of(cube(1, 0.01, friction + "solver: {type: projected_newton, tolerance: 1 cm/s}\n"));
  CHECK_THAT(only_text(creeping, WarningKind::sticking_speed), Catch::StartsWith("contact.pairs[0].friction.eps_v 0.001 m/s is below solver.tolerance 0.01 m/s"));
  CHECK(warnings_of(cube(1, 0.01, friction + "solver: {type: projected_newton, tolerance: 0.1 mm/s}\n")).empty());
  CHECK(warnings_of(cube(1, 0.01, friction + "solver: {type: projected_newton, stopping: force}\n")).empty());
}
