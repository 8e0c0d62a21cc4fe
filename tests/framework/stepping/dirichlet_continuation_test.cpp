// Dirichlet continuation: prescribed surfaces that move to their target positions through
// obstacles.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/contact/contact_system.hpp"
#include "framework/stepping/dirichlet_continuation.hpp"
#include "geometry/exact/intersections.hpp"
#include "tests/support/step_problem.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A ball on grains in a pan that rests for 0.4 s and then rotates.
std::string rocked_pan(const std::string& step, const std::string& stiffness) {
  return fmt::format(
      "gravity: [0, -9.81, 0]\n"
      "time: {{step: {}, duration: 0.7}}\n"
      "solver: {{type: projected_newton, tolerance: 5 mm/s}}\n"
      "contact: {{distance: 0.4 mm, barrier: {{stiffness: {}}}, friction: {{mu: 0.4, eps_v: 2 cm/s}}}}\n"
      "objects:\n"
      "  - name: pan\n"
      "    shape: {{type: revolve, profile_x: 0.07 * s, profile_y: 0.05 * s^6, cells_profile: 10, cells_around: 24}}\n"
      "    motion:\n"
      "      - type: keyframes\n"
      "        frames:\n"
      "          - {{time: 0.4 s}}\n"
      "          - {{time: 0.5 s, rotation: [35 deg, 0, 0]}}\n"
      "          - {{time: 0.7 s, rotation: [-35 deg, 0, 0]}}\n"
      "  - name: ball\n"
      "    shape: {{type: sphere, radius: 14 mm, cells: 6, surface: true}}\n"
      "    place: {{translate: [0, 42 mm, 0]}}\n"
      "    body: {{type: affine, density: 4000}}\n"
      "  - name: rice\n"
      "    shape: {{type: revolve, profile_x: 0.004 * sqrt(s * (1 - s)), profile_y: 0.004 * (2 * s - 1), cells_profile: 3, cells_around: 6}}\n"
      "    body: {{type: affine, density: 1200}}\n"
      "    fill: {{region: {{type: cylinder, radius: 30 mm, height: 18 mm, place: {{translate: [0, 17 mm, 0]}}}}, count: 40, clearance: 0.85 mm}}\n",
      step, stiffness);
}

// One continuation of a plate that rises by 20 mm under a block 5 mm above it.
struct Continuation : StepProblem {
  explicit Continuation(const std::string& block)
      : StepProblem(fmt::format("time: {{step: 0.01, duration: 1}}\n"
                                "objects:\n"
                                "  - {{name: plate, shape: {{type: box, size: [0.1, 0.01, 0.1]}}, motion: [{{type: translate, velocity: [0, 2, 0]}}]}}\n"
                                "  - {{name: block, shape: {{type: box, size: [0.05, 0.05, 0.05]}}, place: {{translate: [0, 0.035, 0]}}, {}}}\n"
                                "  - {{name: free, shape: {{type: box, size: [0.01, 0.01, 0.01]}}, place: {{translate: [0, 5, 0]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n"
                                "contact: {{distance: 1 mm}}\n",
                                block)) {
    steps.observe([this](const VecX& x, const VecX& p, double t) { feasible = feasible && !intersects(x) && !intersects(x + t * p); });
  }
  bool intersects(const VecX& x) const { return !find_intersections(world->contact->surface().mesh, x, world->contact->colliding(), 1).empty(); }
  DirichletContinuation::Result run() { return DirichletContinuation(*world, *solver, clock, steps).run(step.state.x, step.targets, step.prediction); }
  double left(const VecX& x) const {  // largest distance of a vertex of the plate to its target [m]
    double largest = 0;
    for (const int v : world->vertices_of(0)) largest = std::max(largest, (vertex(x, v) - vertex(step.targets, v)).norm());
    return largest;
  }
  bool feasible = true;  // every start and end of a step that was taken
};

}  // namespace

TEST_CASE("a continuation ends exactly at the targets, by feasible steps alone") {
  Continuation c("energies: [{type: neo_hookean, young: 1e5, density: 1000}]");
  const DirichletContinuation::Result result = c.run();
  CHECK(result.failure.empty());
  CHECK(result.solve.status == MinimizerStatus::converged);
  CHECK(c.left(result.x) == 0);
  CHECK(c.feasible);
  CHECK_FALSE(c.intersects(result.x));
  CHECK(result.solve.iterations > 0);
}

TEST_CASE("a continuation against a fixed obstacle fails with its name, at the nearest feasible positions") {
  Continuation c("motion: [fixed]");
  const DirichletContinuation::Result result = c.run();
  CHECK_THAT(result.failure, Catch::Contains("'plate' into 'block'"));
  CHECK(c.feasible);
  CHECK(c.left(result.x) > 0.015);  // it may rise by less than 5 mm
  CHECK(c.left(result.x) < 0.02);
  for (const int v : c.world->vertices_of(1)) CHECK(Vec3(vertex(result.x, v)) == Vec3(vertex(c.step.state.x, v)));
}

TEST_CASE("continuations of one object are independent of each other") {
  Continuation c("energies: [{type: neo_hookean, young: 1e5, density: 1000}]");
  DirichletContinuation continuation(*c.world, *c.solver, c.clock, c.steps);
  const VecX first = continuation.run(c.step.state.x, c.step.targets, c.step.prediction).x;
  const DirichletContinuation::Result second = continuation.run(c.step.state.x, c.step.targets, c.step.prediction);
  CHECK(second.failure.empty());
  CHECK((second.x - first).lpNorm<Eigen::Infinity>() < 1e-4);
}

// In one stage, the grains would have to rotate in an iteration by more than CCD allows, and gaps would vanish.
// The grains' paths are chaotic: in 16 runs whose gravity differs by 1e-9 of itself, smallest gaps are 4.7e-7 to 1.2e-4 m, and
// in 5 of them a grain passes through another one in a long step, which repeats that step in halves. No solve fails.
TEST_CASE("a pan rotates under grains and a ball without a failed solve") {
  const auto [step, stiffness] = GENERATE(table<std::string, std::string>({{"16 ms", "2 kPa"}, {"40 ms", "10 kPa"}}));
  INFO("steps of " << step << ", " << stiffness);
  TestRun run(rocked_pan(step, stiffness));
  while (!run.stepper.finished()) CHECK(run.step().min_distance > 1e-7);
  for (const Warning& warning : run.warnings)
    if (warning.kind == WarningKind::step_cutback) CHECK_THAT(warning.text, Catch::Matchers::Contains("tunnelled through"));
  CHECK_FALSE(run.intersects());
}

// Bonds would break along linear trajectories, so that the strip moves by continuation. The rollers
// under the other strip must stay fixed meanwhile.
TEST_CASE("rollers stay at their positions during Dirichlet continuation") {
  const char* const strip =
      "shape: {type: grid, size: [0.08, 0.002], cells: [80, 1]}, shell: {thickness: 1 mm}, contact_offset: 0.47 mm,\n"
      "     energies: [{type: stvk_membrane, young: 1 GPa, poisson: 0}, {type: hinge_bending, young: 1 GPa, poisson: 0}]";
  TestRun run(fmt::format(
      "time: {{step: 0.025, duration: 1, integrator: quasi_static}}\n"
      "objects:\n"
      "  - {{name: lo, {0}, place: {{translate: [0.04, -0.5 mm, 0]}},\n"
      "     motion: [{{type: fixed, along: [0, 1, 0], select: {{type: face, direction: [-1, 0, 0]}}}},\n"
      "              {{type: fixed, along: [0, 1, 0], select: {{type: face, direction: [1, 0, 0]}}}},\n"
      "              {{type: fixed, along: [1, 0, 0], select: {{type: face, direction: [1, 0, 0]}}}}, {{type: fixed, along: [0, 0, 1]}}]}}\n"
      "  - {{name: up, {0}, place: {{translate: [0.04, 0.5 mm, 0]}},\n"
      "     motion: [{{type: formula, y: -0.004 * t, along: [0, 1, 0], select: {{type: formula, where: abs(x - 0.04) < 0.00025}}}},\n"
      "              {{type: fixed, along: [0, 0, 1]}}]}}\n"
      "contact:\n"
      "  distance: 0.05 mm\n"
      "  barrier: {{type: clamped_log, stiffness: 1 MPa}}\n"
      "  pairs:\n"
      "    - between: [{{object: up, select: {{type: formula, where: x > 0.029999}}}}, {{object: lo, select: {{type: formula, where: x > 0.029999}}}}]\n"
      "      bond_distance: 0.078 mm\n"
      "      adhesion: {{type: bilinear, peak_traction: 0.5 MPa, work_of_adhesion: 5, tangential_strength: 0.5 MPa, mixed_mode: benzeggagh_kenane, tangential_work: 10}}\n"
      "    - {{between: [up, up], contact: false}}\n"
      "    - {{between: [lo, lo], contact: false}}\n",
      strip));
  for (int i = 0; i < 5; ++i) {
    INFO("step " << i + 1);
    CHECK(run.step().rejections.cutbacks() == 0);
  }
}
