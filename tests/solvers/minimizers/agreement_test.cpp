// Every registered minimizer, with every choice of its own, finds the minimum that projected Newton finds.
#include <catch2/catch.hpp>

#include "framework/core/minimizer.hpp"
#include "solvers/line_search/line_search.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/rms_difference.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A cube that hits a sticky, rough floor at an angle, in the first step.
std::string impact(const std::string& solver, const std::string& duration = "0.05") {
  return "time: {step: 0.01, duration: " + duration + "}\ngravity: [0, -9.81, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n"
         "  - {name: cube, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]},\n"
         "     place: {axis: [0, 0, 1], angle: 0.05, translate: [0, 0.056, 0]}, velocity: [0.5, -0.5, 0],\n"
         "     energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}]}\n"
         "contact:\n  distance: 2e-3\n  friction: {mu: 0.3, eps_v: 0.01}\n"
         "  pairs: [{between: [cube, floor], adhesion: {type: fang, critical_strain: 0.01}}]\n"
         "solver: " + solver + "\n";
}

// Vertices that several unknowns move, or with fixed directions: an affine box and, on its top, a tied soft one drop askew
// onto a floor; a third slides along rails. The affine one is soft, for methods that a stiff one would take too long.
std::string followers(const std::string& solver) {
  const std::string soft = "energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}]";
  return "time: {step: 0.01, duration: 0.04}\ngravity: [0, -9.81, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n"
         "  - {name: base, shape: {type: box, size: [0.1, 0.1, 0.1]}, surface: {edge_length: 0.08},\n"
         "     place: {axis: [0, 0, 1], angle: 0.05, translate: [0, 0.056, 0]}, velocity: [0.3, -0.2, 0],\n"
         "     body: {type: affine, density: 1000, stiffness: 1e6}}\n"
         "  - {name: top, shape: {type: box, size: [0.06, 0.06, 0.06]}, velocity: [0.3, -0.2, 0],\n"
         "     place: {axis: [0, 0, 1], angle: 0.05, translate: [-0.00399833354165, 0.13590002083160, 0]}, " + soft + ",\n"
         "     attach: [{to: base, within: 1 mm, select: {type: face, direction: [0.049979169270678, -0.998750260394966, 0]}}]}\n"
         "  - {name: slider, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [1, 2, 1]}, velocity: [-0.5, -0.5, 0],\n"
         "     place: {translate: [0.14, 0.053, 0]}, " + soft + ",\n"
         "     motion: [{type: fixed, along: [0.3, 0, 1], select: {type: face, direction: [0, 0, 1]}}]}\n"
         "contact:\n  distance: 2e-3\n  friction: {mu: 0.3, eps_v: 0.01}\n"
         "solver: " + solver + "\n";
}

// A thick soft rod that is bent at rest. A prescribed motion twists one end; a particle hangs on a spring at the other.
std::string rod(const std::string& solver) {
  return "time: {step: 0.01, duration: 0.04}\ngravity: [0, -9.81, 0]\n"
         "objects:\n"
         "  - {name: rod, shape: {type: helix, radius: 0.3, pitch: 0.2, turns: 0.5, edges: 6}, rod: {width: 0.08, height: 0.1, normal: [0, 1, 0]},\n"
         "     energies: [{type: elastic_rod, young: 1e5, poisson: 0.3, density: 1000}],\n"
         "     motion: [{type: rotate, axis: [0, 0, 1], angular_velocity: 8 rad/s, select: {type: indices, vertices: [0, 1]}}]}\n"
         "  - {name: ball, shape: {type: points}, place: {translate: [-0.3, -0.1, 0]}, particle: {radius: 0.05}, energies: [{type: particle, mass: 2}]}\n"
         "interactions: [{type: spring, name: cord, from: {object: ball}, to: {object: rod, select: {type: indices, vertices: [6]}}, stiffness: 500}]\n"
         "solver: " + solver + "\n";
}

struct Outcome {
  VecX x;
  int iterations = 0;
};

Outcome outcome(const std::string& scene) {
  TestRun simulation(scene);
  Outcome outcome;
  while (!simulation.stepper.finished()) {
    const StepReport report = simulation.step();
    CHECK(report.converged);
    CHECK(report.min_distance > 0);
    CHECK(report.intersections == 0);
    outcome.iterations += report.solve.iterations;
  }
  std::erase_if(simulation.warnings, [](const Warning& w) { return w.kind == WarningKind::affine_strain; });
  CHECK(simulation.warnings == std::vector<Warning>{});
  outcome.x = simulation.state().x;
  return outcome;
}

// Tolerances of about equal strictness.
const std::map<std::string, std::string> tight = {
    {"tolerance", "1e-8"}, {"force_tolerance", "1e-8"}, {"acceleration_tolerance", "1e-4"}, {"max_iterations", "60000"}};

// all: otherwise methods with the full metric, factorised, which take longest, have one stopping rule alone.
void check_agreement(const std::string& duration, bool all) {
  const Outcome reference = outcome(impact("{type: projected_newton, tolerance: 1e-10, linear: cholmod}", duration));
  for (const ComponentVariant& v : variants<Minimizer>({tight})) {
    INFO(v.yaml);
    if (!all && v.yaml.find("metric: full") != v.yaml.npos && v.yaml.find("stopping: velocity") == v.yaml.npos) continue;
    const Outcome other = outcome(impact(v.yaml, duration));
    CHECK(rms_difference(other.x, reference.x) < 1e-7);  // 1e-6 of the cube
    UNSCOPED_INFO(v.type << " took " << other.iterations << " iterations");
  }
}

}  // namespace

TEST_CASE("minimizers agree", "[minimizer]") { check_agreement("0.02", false); }
TEST_CASE("minimizers agree on an impact and its aftermath", "[minimizer][nightly]") { check_agreement("0.05", true); }

TEST_CASE("minimizers agree with dependent vertices and fixed directions", "[minimizer]") {
  const Outcome reference = outcome(followers("{type: projected_newton, tolerance: 1e-10, linear: cholmod}"));
  for (const ComponentVariant& v : variants<Minimizer>({tight})) {
    INFO(v.yaml);
    const Outcome other = outcome(followers(v.yaml));
    CHECK(rms_difference(other.x, reference.x) < 1e-7);
    UNSCOPED_INFO(v.type << " took " << other.iterations << " iterations");
  }
}

TEST_CASE("minimizers agree on rods", "[minimizer][rod]") {
  const Outcome reference = outcome(rod("{type: projected_newton, tolerance: 1e-10, linear: cholmod}"));
  for (const ComponentVariant& v : variants<Minimizer>({tight})) {
    INFO(v.yaml);
    const Outcome other = outcome(rod(v.yaml));
    CHECK(rms_difference(other.x, reference.x) < 1e-7);
    UNSCOPED_INFO(v.type << " took " << other.iterations << " iterations");
  }
}

TEST_CASE("line searches lead to the same minimum", "[minimizer][line_search]") {
  const Outcome reference = outcome(impact("{type: projected_newton, tolerance: 1e-10, linear: cholmod}"));
  for (const std::string& search : Registry<LineSearch>::kind().names())
    for (const char* type : {"projected_newton", "lbfgs"}) {
      INFO(type << " with " << search);
      const Outcome other =
          outcome(impact(std::string("{type: ") + type + ", tolerance: 1e-8, line_search: " + search + "}"));
      CHECK(rms_difference(other.x, reference.x) < 1e-7);
    }
}
