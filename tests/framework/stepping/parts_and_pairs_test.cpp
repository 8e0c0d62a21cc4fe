// Parts of the incremental potential, and close pairs of primitives as data.
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/contact/contact_system.hpp"
#include "geometry/errors.hpp"
#include "tests/support/step_problem.hpp"

using namespace tack;

namespace {

// Cubes that press on each other and rub, one affine; a sheet that is glued on.
const std::string scene =
    "time: {step: 10 ms}\ngravity: [0, -9.81, 0]\n"
    "objects:\n"
    "  - {name: floor, shape: {type: grid, size: [0.5, 0.5], cells: [3, 3]}, motion: [fixed]}\n"
    "  - {name: lower, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0, 0.0507, 0]}, velocity: [0.3, 0, 0],\n"
    "     energies: [{type: neo_hookean, young: 1e5, density: 1000}], damping: {mass: 2}}\n"
    "  - {name: upper, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {axis: [0, 1, 0], angle: 0.4,\n"
    "     translate: [0.02, 0.1514, 0.01]}, body: {type: affine, density: 1000}}\n"
    "contact:\n  distance: 1 mm\n  friction: {mu: 0.4}\n"
    "  pairs: [{between: [lower, upper], friction: {mu: 0.3}, adhesion: {type: fang, peak_traction: 500}}]\n";

VecX moved(const StepProblem& s) {
  VecX q = s.q;
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] += 1e-5 * std::sin(1 + 3.0 * static_cast<double>(i));
  return q;
}

}  // namespace

TEST_CASE("the parts of the incremental potential add up to it", "[parts]") {
  StepProblem s(scene);
  const VecX q = moved(s);
  s.potential.move_to(q);
  const std::vector<ObjectivePart> parts = s.potential.parts();
  REQUIRE(parts.size() > 4);
  CHECK(parts[0].name == "inertia");
  double value = 0;
  VecX gradient = VecX::Zero(s.potential.size());
  int dynamic = 0, dissipative = 0, acting = 0;
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
    value += s.potential.part_value(i);
    const VecX own = s.potential.part_gradient(i);
    gradient += own;
    acting += own.norm() > 0;
    dynamic += parts[i].dynamic;
    dissipative += !parts[i].stores;
  }
  CHECK(value == Approx(s.potential.value()).epsilon(1e-12));
  CHECK((gradient - s.potential.gradient()).norm() < 1e-12 * gradient.norm());
  CHECK(acting > 4);
  CHECK(dynamic >= 3);
  CHECK(dissipative >= 1);
}

TEST_CASE("close pairs have the closest points and gaps of their primitives", "[pairs]") {
  StepProblem s(scene);
  MinimizerProblem problem{s.potential, {}, {}, s.clock};
  s.steps.set_feasibility(s.potential, problem);
  const VecX q = moved(s), x = s.configuration(q);
  const double range = s.world->contact->range();
  const std::vector<ClosePair> all = problem.pairs(q, range), few = problem.pairs(q, 0.7e-3);
  REQUIRE(all.size() > few.size());
  REQUIRE(!few.empty());
  CHECK(std::is_sorted(all.begin(), all.end()));
  double smallest = INFINITY;
  for (const ClosePair& pair : all) {
    Vec3 apart = Vec3::Zero();
    double first = 0, second = 0;
    for (int i = 0; i < pair.count; ++i) {
      const bool of_first = i < pair.first_count;
      CHECK(pair.weights[i] >= -1e-12);
      (of_first ? first : second) += pair.weights[i];
      apart += (of_first ? 1 : -1) * pair.weights[i] * Vec3(vertex(x, pair.vertices[i]));
    }
    CHECK(first == Approx(1));
    CHECK(second == Approx(1));
    CHECK((apart - pair.distance * pair.normal).norm() < 1e-15);
    CHECK(pair.bodies[0] >= 0);
    smallest = std::min(smallest, pair.gap());
  }
  CHECK(smallest == Approx(s.world->contact->smallest_gaps(x).of_all));
  CHECK_THROWS_AS(problem.pairs(q, 2 * range), InputError);
}
