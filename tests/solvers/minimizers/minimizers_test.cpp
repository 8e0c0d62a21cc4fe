// Every registered minimiser, with every option: the same minimum, never through anything, within its
// budget, and with an honest status.
#include <catch2/catch.hpp>
#include <numeric>

#include "framework/contact/contact_system.hpp"
#include "framework/core/deadline.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/exact/intersections.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/on_floor.hpp"
#include "tests/support/rms_difference.hpp"
#include "tests/support/step_problem.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A sticky block that falls on a floor, askew: adhesion, friction, elasticity and inertia.
const std::string landing = step_on_floor(R"(
  - name: block
    shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}
    place: {axis: [0.2, 0, 1], angle: 0.004, translate: [0, 0.1013, 0]}
    velocity: [0.3, -0.2, 0]
    energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}]
contact:
  distance: 2 mm
  friction: {mu: 0.5, eps_v: 1 cm/s}
  pairs: [{between: [block, floor], adhesion: {type: fang, critical_strain: 0.01}}]
)");

// A block that is shot at a plate a hundredth as thick as its displacement in the step.
const std::string shot = R"(
time: {step: 0.01, duration: 0.01}
objects:
  - {name: plate, shape: {type: box, size: [1, 0.004, 1]}, place: {translate: [0, -0.002, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [0.1, 0.1, 0.1]}
    place: {axis: [0.3, 0.1, 1], angle: 0.3, translate: [0, 0.12, 0]}
    velocity: [3, -40, 1]
    energies: [{type: neo_hookean, young: 1e6, poisson: 0.3, density: 1000}]
contact: {distance: 1 mm}
)";

// Each type with each of its own options; a choice that another one makes void is tried once.
std::vector<ComponentVariant> minimizers() {
  std::vector<ComponentVariant> chosen;
  for (const ComponentVariant& v : variants<Minimizer>()) {
    const auto has = [&](const std::string& part) { return v.yaml.find(part) != std::string::npos; };
    if (!has("stopping: velocity")) continue;
    if (has("conjugate:") && !has("fletcher_reeves") && !has("direction: nonlinear")) continue;
    chosen.push_back(v);
  }
  return chosen;
}

std::unique_ptr<Minimizer> with(const ComponentVariant& v, const std::string& more) {
  return component<Minimizer>(v.yaml.substr(0, v.yaml.size() - 1) + ", " + more + "}");
}

template <class Check>
void for_each_minimizer(const Check& check) {
  const auto all = minimizers();
  REQUIRE(all.size() >= 1);
  for (const ComponentVariant& v : all) {
    INFO(v.yaml);
    check(v);
  }
}

}  // namespace

TEST_CASE("minimizers: all find the same minimum", "[minimizer]") {
  StepProblem reference(landing);
  REQUIRE(reference.minimize(*component<Minimizer>("{type: projected_newton, tolerance: 1e-8}")).status ==
          MinimizerStatus::converged);
  const double lowest = (reference.potential.move_to(reference.q), reference.potential.value());
  for_each_minimizer([&](const ComponentVariant& v) {
    StepProblem problem(landing);
    const MinimizerResult result = problem.minimize(*with(v, "tolerance: 1e-5, max_iterations: 20000"));
    INFO(to_string(result.status) << ", " << result.iterations << " iterations, "
                                  << result.line_search_evaluations << " evaluations, residual " << result.residual);
    CHECK(result.status == MinimizerStatus::converged);
    CHECK(result.residual <= 1);
    CHECK(result.iterations > 0);
    CHECK(result.linear_solves > 0);
    CHECK(rms_difference(problem.q, reference.q) <= 1e-6);  // of a scene of one metre
    problem.potential.move_to(problem.q);
    CHECK(problem.potential.value() == Approx(lowest).epsilon(1e-7));
  });
}

TEST_CASE("minimizers: none passes through a thin plate", "[minimizer]") {
  for_each_minimizer([&](const ComponentVariant& v) {
    StepProblem problem(shot);
    const MinimizerResult result = problem.minimize(*with(v, "tolerance: 0.01, max_iterations: 1000"));
    INFO(to_string(result.status) << ", " << result.iterations << " iterations, residual " << result.residual);
    CHECK(problem.path.size() > 1);
    const auto& surface = problem.world->contact->surface();
    for (size_t i = 0; i < problem.path.size(); ++i) {
      // The plate is wider than the block's path: between two points on its upper side there is no crossing.
      for (int y = 1; y < problem.q.size(); y += 3) REQUIRE(problem.path[i](y) > 0);
      REQUIRE(find_intersections(surface.mesh, problem.configuration(problem.path[i]),
                                 problem.world->contact->colliding(), 1).empty());
      if (i > 0 && i % 7 == 0) {
        for (const double t : {0.2, 0.4, 0.6, 0.8}) {
          const VecX between = (1 - t) * problem.path[i - 1] + t * problem.path[i];
          REQUIRE(find_intersections(surface.mesh, problem.configuration(between), problem.world->contact->colliding(),
                                     1).empty());
        }
      }
    }
    CHECK((result.status == MinimizerStatus::converged || result.status == MinimizerStatus::iteration_limit));
  });
}

TEST_CASE("minimizers: all notify the observer of every iteration", "[minimizer]") {
  for_each_minimizer([&](const ComponentVariant& v) {
    StepProblem problem(landing);
    std::vector<int> told;
    double value = 0, seconds = 0;
    const auto observer = [&](int iteration, double residual, double lower, double later) {
      told.push_back(iteration);
      CHECK(residual >= 0);
      CHECK(lower <= (told.size() == 1 ? lower : value + 1e-9 * std::abs(value)));
      CHECK(later >= seconds);
      value = lower;
      seconds = later;
    };
    const MinimizerResult result = problem.minimize(*with(v, "tolerance: 0.01, max_iterations: 100"), observer);
    REQUIRE(result.iterations > 0);
    std::vector<int> expected(static_cast<size_t>(result.iterations));
    std::iota(expected.begin(), expected.end(), 1);
    CHECK(told == expected);
    CHECK(value == problem.potential.value());
  });
}

TEST_CASE("minimizers: iteration limits are respected", "[minimizer]") {
  for_each_minimizer([&](const ComponentVariant& v) {
    StepProblem problem(landing);
    const int counted = problem.potential.value_count();
    const MinimizerResult result = problem.minimize(*with(v, "tolerance: 1e-9, max_iterations: 2"));
    CHECK(result.status == MinimizerStatus::iteration_limit);
    CHECK(result.iterations <= 2);
    CHECK(result.line_search_evaluations <= 130);
    CHECK(problem.potential.value_count() - counted <= 130);
    CHECK(problem.q.allFinite());
  });
}

TEST_CASE("minimizers: Ctrl-C ends them at the current iterate", "[minimizer]") {
  for_each_minimizer([&](const ComponentVariant& v) {
    StepProblem problem(landing);
    const VecX start = problem.q;
    interrupt_requested = true;
    const MinimizerResult result = problem.minimize(*with(v, "tolerance: 1e-9"));
    interrupt_requested = false;
    CHECK(result.status == MinimizerStatus::interrupted);
    CHECK(problem.q == start);
  });
}

TEST_CASE("minimizers: a lack of time ends them at a feasible point", "[minimizer]") {
  for_each_minimizer([&](const ComponentVariant& v) {
    for (const int calls : {0, 1, 4}) {
      StepProblem problem(landing);
      const auto minimizer = with(v, "tolerance: 1e-12, max_iterations: 20000");
      int left = calls;
      const MinimizerProblem out_of_time{
          problem.potential,
          [&](const VecX& from, const VecX& p) {
            const double t = problem.feasible_step(from, p);
            if (left-- == 0) throw OutOfTime();
            return t;
          },
          [](const VecX&, const VecX&) { return 1e9; }, problem.clock, true};
      const MinimizerResult result = minimizer->minimize(out_of_time, problem.q);
      CHECK(result.status == MinimizerStatus::time_limit);
      CHECK(result.iterations <= calls + 1);
      CHECK(problem.q == problem.path.back());  // the last point that it tried to leave
    }
  });
}

TEST_CASE("minimizers: quasi-static steps", "[minimizer]") {
  // A bar without inertia that bends under gravity and is pulled: all linear forces belong to the rest.
  const auto positions = [](const std::string& type) {
    TestRun s("time: {step: 1, duration: 1, integrator: quasi_static}\ngravity: [0, -1, 0]\n"
                 "solver: {type: " + type + ", force_tolerance: 1e-8, max_iterations: 5000}\n"
                 "objects: [{name: bar, shape: {type: box, size: [0.5, 0.1, 0.1], cells: [5, 2, 2]},\n"
                 "  energies: [{type: neo_hookean, young: 1e5, poisson: 0.3}],\n"
                 "  motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}}],\n"
                 "  loads: [{type: traction, value: [2e4, 0, 0], select: {type: face, direction: [1, 0, 0]}}]}]\n");
    CHECK(s.step().converged);
    CHECK(s.warnings.empty());
    return s.state().x;
  };
  const VecX expected = positions("projected_newton");
  for (const std::string& type : Registry<Minimizer>::kind().names()) {
    INFO(type);
    CHECK(rms_difference(positions(type), expected) <= 1e-7);
  }
}

TEST_CASE("minimizers: a plate with a prescribed motion", "[minimizer]") {
  // The plate would go through the block: it walks, with a pull that gradient methods find hard. It also moves
  // aside: pressed straight down, the block may buckle to either side.
  const auto positions = [](const std::string& type) {
    TestRun s("time: {step: 1, duration: 2, integrator: quasi_static}\n"
                 "solver: {type: " + type + ", force_tolerance: 1e-8}\n"
                 "objects:\n"
                 "  - {name: plate, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, 0.101, 0]},\n"
                 "     motion: [{type: translate, displacement: [1 mm, -0.04, 0], duration: 2 s}]}\n"
                 "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]},\n"
                 "     energies: [{type: neo_hookean, young: 1e5}],\n"
                 "     motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}\n"
                 "contact: {distance: 2 mm, friction: {mu: 0.3}}\n");
    CHECK(s.step().converged);
    CHECK(s.step().converged);
    CHECK(s.warnings.empty());
    return s.state().x;
  };
  CHECK(rms_difference(positions("ceres_trust_region"), positions("projected_newton")) <= 1e-6);
}

TEST_CASE("minimizers: those that need dense matrices refuse many unknowns", "[minimizer]") {
  const auto admit = [](const std::string& yaml, int unknowns) {
    component<Minimizer>(yaml)->admit({}, unknowns);
  };
  CHECK_NOTHROW(admit("{type: nlopt, algorithm: slsqp}", 300));
  CHECK_THROWS_WITH(admit("{type: nlopt, algorithm: slsqp}", 3000), Catch::Contains("slsqp") && Catch::Contains("3000"));
  CHECK_NOTHROW(admit("{type: nlopt, algorithm: lbfgs}", 300000));
  CHECK_NOTHROW(admit("{type: ceres_line_search, direction: bfgs}", 3000));
  CHECK_THROWS_WITH(admit("{type: ceres_line_search, direction: bfgs}", 30000), Catch::Contains("lbfgs"));
  CHECK_NOTHROW(admit("{type: ceres_line_search}", 300000));
}
