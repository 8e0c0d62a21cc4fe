// Hessians with projected contact and exact elements.
#include <catch2/catch.hpp>

#include "tests/support/on_floor.hpp"
#include "tests/support/random_blocks.hpp"
#include "tests/support/step_problem.hpp"

using namespace tack;

namespace {

// A block at rest within the contact distance of a floor: its elements are positive semi-definite, its contacts are not.
const std::string near = step_on_floor(R"(
  - name: block
    shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}
    place: {axis: [0, 0, 1], angle: 45 deg, translate: [0.01, 0.1417, 0.02]}
    energies: [{type: neo_hookean, young: 1e6, poisson: 0.4, density: 1000}]
contact: {distance: 1 mm}
)");

double difference(const MatX& a, const MatX& b) { return (a - b).norm() / b.norm(); }

}  // namespace

TEST_CASE("contacts are projected, elements stay exact", "[assembly]") {
  StepProblem step(near);
  IncrementalPotential& potential = step.potential;
  const auto hessians = [&] {
    const MatX partly = dense(potential.hessian({.dynamic_projection = Projection::clamp}));
    const MatX clamped = dense(potential.hessian({Projection::clamp})), exact = dense(potential.hessian({Projection::none}));
    return std::array{partly, clamped, exact};
  };
  const VecX rest = step.q;
  potential.move_to(rest);
  {
    const auto [partly, clamped, exact] = hessians();
    CHECK(difference(partly, clamped) < 1e-12);
    CHECK(difference(partly, exact) > 1e-6);
  }
  VecX pressed = rest;  // to half its height, and away from the floor
  for (int i = 1; i < pressed.size(); i += 3) pressed(i) = 0.3 + 0.5 * rest(i);
  potential.move_to(pressed);
  {
    const auto [partly, clamped, exact] = hessians();
    CHECK(difference(partly, exact) < 1e-12);
    CHECK(difference(partly, clamped) > 1e-6);
  }
}
