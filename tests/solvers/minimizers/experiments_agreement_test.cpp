// Every registered minimizer ends where projected Newton does, in the first steps of the experiments on
// coarse meshes. Friction that is lagged makes each step's minimum unique; what would not be unique
// (buckling) comes later than these steps.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/core/minimizer.hpp"
#include "framework/run/simulation.hpp"
#include "tests/support/rms_difference.hpp"

using namespace tack;

namespace {

struct Case {
  const char* file;  // in experiments/
  std::vector<std::string> overrides;
  int steps;
  bool stiff = false;  // block descent takes 30000 sweeps
};

const std::vector<Case> cases = {
    {"debonding/pull.yaml", {"objects.0.shape.cells=[3,1,3]", "objects.1.shape.cells=[4,1,4]"}, 3},
    {"stack/two_blocks.yaml", {"objects.lower.shape.cells=[2,2,2]", "objects.upper.shape.cells=[2,2,2]"}, 12},
    {"slope/slide.yaml", {}, 4},
    {"wall_cube/detaches.yaml", {"objects.cube.shape.cells=[3,3,3]"}, 6},
    {"arch/collapses.yaml", {}, 2, true},
    {"twist/mat.yaml", {"objects.mat.shape.cells=[8,1,8]"}, 4},
};

struct Outcome {
  VecX x;
  double size;  // of the scene [m]
  std::string trouble;
};

Outcome run(const Case& c, const std::string& solver) {
  std::vector<std::string> overrides = c.overrides;
  overrides.push_back("solver=" + solver);
  Outcome outcome{{}, 0, ""};
  Simulation simulation(load_experiment(std::string(TACK_SOURCE_DIR "/experiments/") + c.file, overrides),
                        [&](const std::string& line) { outcome.trouble += line; });
  simulation.start();
  for (int step = 0; step < c.steps; ++step) {
    const StepReport report = simulation.step();
    CHECK(report.intersections == 0);
    CHECK(report.min_distance > 0);
  }
  outcome.x = simulation.state().x;
  const auto x = simulation.world().rest.reshaped(3, simulation.world().rest.size() / 3);
  outcome.size = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  return outcome;
}

}  // namespace

TEST_CASE("minimizers agree on the experiments", "[minimizer]") {
  const Case& c = GENERATE(from_range(cases));
  INFO(c.file);
  const Outcome reference = run(c, "{type: projected_newton, tolerance: 1e-10, linear: cholmod}");
  CHECK(reference.trouble == "");
  for (const std::string& type : Registry<Minimizer>::kind().names()) {
    if (c.stiff && type == "vertex_block_descent") continue;
    INFO(type);
    const Outcome other = run(c, "{type: " + type + ", tolerance: 1e-8, max_iterations: 20000}");
    CHECK(other.trouble == "");
    CHECK(rms_difference(other.x, reference.x) <= 1e-6 * reference.size);
  }
}
