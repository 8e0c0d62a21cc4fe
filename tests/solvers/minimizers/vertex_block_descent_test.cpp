// Vertex block descent where its sweeps have a closed form, on affine bodies, and for any number of
// threads.
#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/core/minimizer.hpp"
#include "geometry/exact/intersections.hpp"
#include "framework/contact/contact_system.hpp"
#include "solvers/minimizers/unit_colors.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/formula_objective.hpp"
#include "tests/support/step_problem.hpp"

using namespace tack;

namespace {

const std::string plain = ", chebyshev_radius: 0";

ChainEnd minimize(int particles, const std::string& settings, int sweeps = 20000) {
  return minimize_chain(particles, "{type: vertex_block_descent, max_iterations: " + std::to_string(sweeps) + settings + "}", 1e-8);
}

// Two soft cubes that meet, and an affine one above them.
const std::string pile =
    "time: {step: 10 ms}\n"
    "gravity: [0, -9.81, 0]\n"
    "objects:\n"
    "  - {name: floor, shape: {type: grid, size: [0.5, 0.5], cells: [3, 3]}, motion: [fixed]}\n"
    "  - {name: lower, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0, 0.0505, 0]},\n"
    "     energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
    "  - {name: upper, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {axis: [1, 0.3, 2], angle: 0.4,\n"
    "     translate: [0.02, 0.182, 0.01]}, velocity: [0, -1, 0], energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
    "  - {name: top, shape: {type: box, size: [0.05, 0.05, 0.05]}, place: {translate: [0.02, 0.29, 0.01]}, velocity: [0, -2, 0],\n"
    "     body: {type: affine, density: 1000}}\n"
    "contact: {distance: 1 mm, friction: {mu: 0.3}}\n";

}  // namespace

TEST_CASE("block descent: a chain converges as Gauss and Seidel's method does", "[minimizer]") {
  // The error of n particles falls by cos^2(pi / (n + 1)) in a sweep, once slow modes are left.
  for (const int particles : {2, 5, 9}) {
    INFO(particles);
    const int sweeps = particles * particles;
    const double expected = std::pow(std::cos(std::numbers::pi / (particles + 1)), 2);
    const double rate = std::pow(minimize(particles, plain, sweeps + 6).error.norm() / minimize(particles, plain, sweeps).error.norm(), 1.0 / 6);
    CHECK(rate == Approx(expected).epsilon(0.01));
  }
}

TEST_CASE("block descent: Chebyshev's acceleration takes the root of the sweeps", "[minimizer]") {
  const int particles = 12;
  const double radius = std::pow(std::cos(std::numbers::pi / (particles + 1)), 2);
  const ChainEnd unaccelerated = minimize(particles, plain), accelerated = minimize(particles, ", chebyshev_radius: " + std::to_string(radius));
  CHECK(unaccelerated.result.status == MinimizerStatus::converged);
  CHECK(accelerated.result.status == MinimizerStatus::converged);
  CHECK(accelerated.error.norm() < 1e-6);
  CHECK(2 * accelerated.result.iterations < unaccelerated.result.iterations);
}

TEST_CASE("block descent: no two units of a colour are coupled, and an affine body is one unit", "[minimizer]") {
  StepProblem s(pile);
  MinimizerProblem problem{s.potential, {}, {}, s.clock};
  s.steps.set_feasibility(s.potential, problem);
  s.potential.move_to(s.q);
  const BlockMatrix& hessian = s.potential.hessian({Projection::clamp});
  const UnitColors colors(problem, hessian);
  const std::vector<int> unit = problem.motion_units();
  std::vector<int> color(hessian.columns(), -1);
  for (size_t c = 0; c < colors.sets.size(); ++c)
    for (const int b : colors.sets[c]) color[b] = static_cast<int>(c);
  int coupled = 0, joined = 0;
  for (int c = 0; c < hessian.columns(); ++c) {
    REQUIRE(color[c] >= 0);
    for (int k = hessian.column_start[c] + 1; k < hessian.column_start[c + 1]; ++k) {
      const int r = hessian.row[k];
      if (unit[r] == unit[c]) CHECK(color[r] == color[c]);
      else CHECK(color[r] != color[c]);
      ++(unit[r] == unit[c] ? joined : coupled);
    }
  }
  CHECK(coupled > 100);
  CHECK(joined == 6);  // pairs of the four blocks of the affine cube
}

TEST_CASE("block descent: the same bits for any number of threads, and never an intersection", "[minimizer]") {
  const auto end = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    StepProblem s(pile);
    const auto minimizer = component<Minimizer>("vertex_block_descent");
    int observed = 0;
    const MinimizerResult result = s.minimize(*minimizer, [&](int, double, double, double) {
      if (++observed % 5 == 0) REQUIRE(find_intersections(s.world->contact->surface().mesh, s.potential.configuration(), s.world->contact->colliding(), 1).empty());
    });
    CHECK(result.status == MinimizerStatus::converged);
    CHECK(result.iterations > 3);
    return s.q;
  };
  CHECK(end(1) == end(4));
}

TEST_CASE("block descent: the minimum of Newton's method", "[minimizer]") {
  StepProblem newton(pile), sweeps(pile);
  REQUIRE(newton.minimize(*component<Minimizer>("{type: projected_newton, tolerance: 1e-6}")).status == MinimizerStatus::converged);
  const MinimizerResult result = sweeps.minimize(*component<Minimizer>("{type: vertex_block_descent, tolerance: 1e-6}"));
  CHECK(result.status == MinimizerStatus::converged);
  CHECK((sweeps.q - newton.q).lpNorm<Eigen::Infinity>() < 1e-6);
}
