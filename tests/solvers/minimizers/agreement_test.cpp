// Every registered minimizer, with every choice of its own, finds the minimum that projected Newton finds.
#include <catch2/catch.hpp>

#include "framework/core/minimizer.hpp"
#include "solvers/line_search/line_search.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/rms_difference.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A cube that hits a sticky, rough floor at an angle.
std::string impact(const std::string& solver) {
  return "time: {step: 0.01, duration: 0.05}\ngravity: [0, -9.81, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n"
         "  - {name: cube, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]},\n"
         "     place: {axis: [0, 0, 1], angle: 0.05, translate: [0, 0.056, 0]}, velocity: [0.5, -0.5, 0],\n"
         "     energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}]}\n"
         "contact:\n  distance: 2e-3\n  friction: {mu: 0.3, eps_v: 0.01}\n"
         "  pairs: [{between: [cube, floor], adhesion: {type: fang, critical_strain: 0.01}}]\n"
         "solver: " + solver + "\n";
}

struct Outcome {
  VecX x;
  int iterations = 0;
};

Outcome outcome(const std::string& solver) {
  TestRun simulation(impact(solver));
  Outcome outcome;
  while (!simulation.stepper.finished()) {
    const StepReport report = simulation.step();
    CHECK(report.converged);
    CHECK(report.min_distance > 0);
    CHECK(report.intersections == 0);
    outcome.iterations += report.solve.iterations;
  }
  CHECK(simulation.warnings == std::vector<std::string>{});
  outcome.x = simulation.state().x;
  return outcome;
}

// Tolerances that ask for about the same.
const std::map<std::string, std::string> tight = {
    {"tolerance", "1e-8"}, {"force_tolerance", "1e-8"}, {"acceleration_tolerance", "1e-4"}, {"max_iterations", "20000"}};

}  // namespace

TEST_CASE("minimizers agree", "[minimizer]") {
  const Outcome reference = outcome("{type: projected_newton, tolerance: 1e-10, linear: cholmod}");
  for (const Variant& v : variants<Minimizer>({tight})) {
    INFO(v.yaml);
    const Outcome other = outcome(v.yaml);
    CHECK(rms_difference(other.x, reference.x) < 1e-7);  // 1e-6 of the cube
    UNSCOPED_INFO(v.type << " took " << other.iterations << " iterations");
  }
}

TEST_CASE("line searches lead to the same minimum", "[minimizer][line_search]") {
  const Outcome reference = outcome("{type: projected_newton, tolerance: 1e-10, linear: cholmod}");
  for (const std::string& search : Registry<LineSearch>::kind().names())
    for (const char* type : {"projected_newton", "lbfgs"}) {
      INFO(type << " with " << search);
      const Outcome other =
          outcome(std::string("{type: ") + type + ", tolerance: 1e-8, line_search: " + search + "}");
      CHECK(rms_difference(other.x, reference.x) < 1e-7);
    }
}
