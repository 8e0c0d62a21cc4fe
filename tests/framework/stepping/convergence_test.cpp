// Convergence criteria of a minimisation: the error bound of a direction, and the force residual.
#include "framework/stepping/convergence.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/component_variants.hpp"
#include "tests/support/on_floor.hpp"
#include "tests/support/random_blocks.hpp"
#include "tests/support/step_problem.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// Two blocks of very different stiffness and mass, the lower one within contact range of the floor.
const std::string blocks = step_on_floor(R"(
  - name: lower
    shape: {type: box, size: [0.2, 0.1, 0.2], cells: [2, 1, 2]}
    place: {translate: [0, 0.0501, 0]}
    energies: [{type: neo_hookean, young: 1e7, poisson: 0.4, density: 3000}]
  - name: upper
    shape: {type: box, size: [0.1, 0.1, 0.1]}
    place: {translate: [0, 0.1506, 0]}
    velocity: [0, -1, 0]
    energies: [{type: neo_hookean, young: 1e4, poisson: 0.3, density: 100}]
contact: {distance: 1 mm, friction: {mu: 0.5}}
)");

}  // namespace

TEST_CASE("the error of a direction is bounded for any residual", "[stepping]") {
  StepProblem step(blocks);
  const auto minimizer = component<Minimizer>("{type: projected_newton, tolerance: 0.02}");
  Convergence convergence = step.convergence(*minimizer);
  step.potential.move_to(step.q);
  const MatX hessian = dense(step.potential.hessian({Projection::clamp}));
  const Eigen::LDLT<MatX> factor(hessian);
  const auto n = hessian.rows();
  double sharpest = 1e300;
  const auto check = [&](const VecX& r) {
    const VecX missing = factor.solve(r);
    const double norm = convergence.norm(missing, r), bound = convergence.direction_error(r);
    CHECK(norm == Approx(missing.lpNorm<Eigen::Infinity>() / 0.01 / 0.02));
    CHECK(norm <= bound);
    sharpest = std::min(sharpest, bound / norm);
  };
  RandomMotions random(1);
  for (Eigen::Index i = 0; i < n; ++i) check(VecX::Unit(n, i));
  for (int i = 0; i < 20; ++i) check(random.vectors(static_cast<int>(n)));
  for (int i = 0; i < 20; ++i) check(hessian * random.vectors(static_cast<int>(n)));
  VecX fall = VecX::Zero(n);  // residual of a fall of the upper block
  const Body& upper = step.world->bodies[2];
  for (int v = upper.first_vertex; v < upper.first_vertex + upper.vertex_count; ++v)
    fall(3 * step.world->dofs.block(v) + 1) = step.world->mass(v);
  check(fall);
  CHECK(sharpest < 20);  // the bound can be reached
}

TEST_CASE("the reference force is the largest load, element force or inertia force", "[stepping]") {
  StepProblem step(blocks);
  const auto minimizer =
      component<Minimizer>("{type: projected_newton, balance_tolerance: 0.01, force_floor: 0.002}");
  Convergence convergence = step.convergence(*minimizer);
  step.potential.move_to(step.q);
  const VecX gradient = step.potential.gradient();
  const double ratio = convergence.imbalance(gradient);
  const Convergence::ForceResidual found = convergence.force_residual();
  CHECK(found.residual == Approx(gradient.lpNorm<Eigen::Infinity>() / 1e-4));
  CHECK(ratio == Approx(found.residual / found.limit));
  // No element is strained at the start. The reference force is the inertia of an upper corner that stops,
  // or the weight of a lower vertex. The contact force is a hundred times larger.
  double inertia = 0, weight = 0;
  for (int v = 0; v < step.world->mass.size(); ++v) {
    if (step.world->dofs.block(v) < 0) continue;
    inertia = std::max(inertia, step.world->mass(v) * std::abs(vertex(step.world->start.v, v).y()) / 0.01);
    weight = std::max(weight, step.world->mass(v) * 9.81);
  }
  CHECK(found.limit == Approx(0.01 * std::max(inertia, weight) + 0.002).epsilon(1e-6));
  CHECK(step.potential.largest_stencil_force() > 100 * std::max(inertia, weight));
  CHECK(ratio > 1);
}

TEST_CASE("a step reports its force residual", "[stepping]") {
  TestRun s(blocks + "solver: {type: projected_newton, tolerance: 1, balance_tolerance: 1e-6, force_floor: 0.1}\n");
  const StepReport r = s.step();
  CHECK(r.converged);
  CHECK(r.unbalanced_force > 0);
  CHECK(r.unbalanced_force <= r.tolerated_force);
  TestRun loose(blocks + "solver: {type: projected_newton, tolerance: 1, balance_tolerance: 1e9, force_floor: 0.1}\n");
  CHECK(loose.step().unbalanced_force > 100 * r.tolerated_force);  // the balance is a criterion of its own
}

namespace {

// Scene of a cube of the given edge [m], in one step of 10 ms. more: further settings of time.
std::string cube(double size, const std::string& more = "") {
  return fmt::format("time: {{step: 0.01, duration: 0.01{}}}\n"
                     "objects:\n  - {{name: cube, shape: {{type: box, size: [{}, {}, {}]}}, energies: [{{type: neo_hookean, young: 1e5, density: 1000}}]}}\n",
                     more, size, size, size);
}

// Returns the limit of the force residual without forces [N].
double floor_of(const std::string& yaml) {
  StepProblem step(yaml);
  const auto minimizer = component<Minimizer>("{type: projected_newton, tolerance: 0.01}");
  Convergence convergence = step.convergence(*minimizer);
  step.potential.move_to(step.q);
  convergence.imbalance(step.potential.gradient());
  return convergence.force_residual().limit;
}

}  // namespace

TEST_CASE("the force floor is above round-off and below the velocity tolerance", "[stepping]") {
  StepProblem dynamic(cube(0.1));
  CHECK(floor_of(cube(0.1)) == Approx(dynamic.world->mass.maxCoeff() * 0.01 / 0.01));
  const double quasi_static = floor_of(cube(0.1, ", integrator: quasi_static"));
  CHECK(quasi_static > 0);
  CHECK(quasi_static < 1e-9);  // N; the cube is compressed by 1000 N
  CHECK(floor_of(cube(0.2, ", integrator: quasi_static")) == Approx(4 * quasi_static));  // stiffness times size
}

// A soft strip bends under a load at its end. Steel that it does not touch lies beside it, or is pressed.
TEST_CASE("a quasi-static strip bends independently of bodies that do not touch it", "[stepping]") {
  const auto tip = [](const std::string& steel) {
    TestRun s("time: {step: 0.25, duration: 1, integrator: quasi_static}\n"
              "objects:\n"
              "  - name: strip\n"
              "    shape: {type: box, size: [0.1, 0.01, 0.01], cells: [5, 1, 1]}\n"
              "    energies: [{type: neo_hookean, young: 1e4, poisson: 0.3}]\n"
              "    motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}]\n"
              "    loads: [{type: traction, value: [0, -20, 0], ramp: [[0, 0], [1, 1]], select: {type: face, direction: [1, 0, 0]}}]\n" +
              steel + "contact: {distance: 0.001}\n");
    for (int i = 0; i < 4; ++i) s.step();
    const int corner = s.world->bodies[0].vertex_count - 1;
    return s.at(corner).y() - s.rest(corner).y();
  };
  const auto steel = [](double x, double pressure) {
    return fmt::format("  - name: steel\n"
                       "    shape: {{type: box, size: [0.1, 0.1, 0.1]}}\n"
                       "    place: {{translate: [{}, 0, 0]}}\n"
                       "    energies: [{{type: neo_hookean, young: 2e11, poisson: 0.3}}]\n"
                       "    motion: [{{type: fixed, select: {{type: face, direction: [0, -1, 0]}}}}]\n"
                       "    loads: [{{type: traction, value: [0, {}, 0], ramp: [[0, 0], [1, 1]], select: {{type: face, direction: [0, 1, 0]}}}}]\n",
                       x, -pressure);
  };
  const double alone = tip("");
  CHECK(alone < -0.01);
  for (const double x : {0.2, 10.0})
    for (const double pressure : {0.0, 1e8}) CHECK(tip(steel(x, pressure)) == Approx(alone).epsilon(1e-5));
}
