// A run that is resumed from a checkpoint has the bits of one that is not, for every registered
// integrator and stepper, those of plugins included.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <functional>
#include <map>

#include "framework/output/state_file.hpp"
#include "framework/stepping/stepper.hpp"
#include "tests/support/program.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/sliding_block.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

constexpr int steps = 16;

// Runs the scene in one go, and from its checkpoints of the steps 3, 8 and 13, where solvers and
// candidates begin afresh in all runs, as those of the program do. Returns the first difference of the ends, or "".
// report: called for every step of the first run.
std::string difference_after_resumption(const std::string& scene, const std::function<void(const StepReport&)>& report = {}) {
  const TemporaryFolder folder;
  const auto checkpoint = [&](int step) { return folder.path() / fmt::format("{}", step); };
  const auto stored = [](int step) { return step == 3 || step == 8 || step == 13; };
  const auto go_on = [&](TestRun& run) {
    const StepReport done = run.step();
    if (stored(run.state().step)) run.simulation.start_from(run.state());
    return done;
  };
  TestRun whole(scene);
  while (whole.state().step < steps) {
    const StepReport done = go_on(whole);
    if (report) report(done);
    if (!stored(whole.state().step)) continue;
    StateFile file;
    file.kind = StateFile::Kind::checkpoint;
    file.state = whole.state();
    write_state_file(checkpoint(whole.state().step), file);
  }
  for (int from = 0; from < steps; ++from) {
    if (!stored(from)) continue;
    TestRun resumed(scene);
    resumed.simulation.start_from(read_state_file(checkpoint(from), StateFile::Kind::checkpoint).state);
    while (resumed.state().step < steps) go_on(resumed);
    if (const std::string found = first_difference(resumed.state(), whole.state()); !found.empty()) return fmt::format("from step {}: {}", from, found);
  }
  return "";
}

const std::string solver = "solver: {type: projected_newton, linear: cholmod, tolerance: 1e-6}\n";

const std::string sliding = solver + sliding_block;

// A plate moves two contact distances per step into a block, which is fixed at its far side.
const std::string pressed = solver +
                            "objects:\n"
                            "  - {name: plate, shape: {type: box, size: [0.02, 0.2, 0.2]}, place: {translate: [-0.0155, 0, 0]}, motion: [{type: translate, velocity: [0.4, 0, 0]}]}\n"
                            "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0.05, 0, 0]},\n"
                            "     motion: [{type: fixed, select: {type: face, direction: [1, 0, 0]}}], energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}]}\n"
                            "contact: {distance: 1 mm, friction: {mu: 0.3}}\n";

std::string time_of(const std::string& integrator, double step, const std::string& more = "") {
  return fmt::format("time: {{step: {}, duration: 100, integrator: {}{}}}\n", step, integrator, more);
}

bool has_inertia(const std::string& integrator) { return Registry<TimeIntegrator>::make(integrator)->inertia(); }

}  // namespace

TEST_CASE("every integrator resumes from a checkpoint to the bit", "[integrators]") {
  for (const std::string& integrator : Registry<TimeIntegrator>::kind().names()) {
    if (!has_inertia(integrator)) continue;
    for (const std::string adaptive : {"", ", adaptive: {error: 0.05 mm}"}) {
      INFO(integrator << adaptive);
      CHECK(difference_after_resumption(time_of(integrator, 2e-3, adaptive) + sliding) == "");
    }
  }
}

TEST_CASE("every integrator resumes while prescribed motion pushes through an obstacle", "[integrators]") {
  for (const std::string& integrator : Registry<TimeIntegrator>::kind().names())
    for (const std::string adaptive : {"", ", adaptive: {error: 0.5 mm}"}) {
      if (!adaptive.empty() && !has_inertia(integrator)) continue;
      INFO(integrator << adaptive);
      int contacts = 0;
      CHECK(difference_after_resumption(time_of(integrator, 5e-3, adaptive) + pressed, [&](const StepReport& report) { contacts += report.min_distance < 1e-3; }) == "");
      CHECK(contacts > 3);
    }
}

TEST_CASE("every stepper resumes from a checkpoint to the bit", "[integrators]") {
  // A shallow truss snaps through.
  const std::string snapping =
      "objects:\n"
      "  - {name: supports, shape: {type: points, size: [2, 0, 0], counts: [2, 1, 1]}, particle: {radius: 1 mm}, motion: [fixed]}\n"
      "  - {name: apex, shape: {type: points}, place: {translate: [0, 0.2, 0]}, particle: {radius: 1 mm}, energies: [{type: particle, mass: 1}],\n"
      "     motion: [{type: fixed, along: [0, 0, 1]}], loads: [{type: force, value: [0, -1, 0], ramp: [[-100, -100], [100, 100]]}]}\n"
      "interactions: [{name: bars, type: spring, from: {object: supports}, to: {object: apex}, stiffness: 1000}]\n";
  std::string without_bonds = sliding;
  without_bonds.replace(without_bonds.find(",\n  pairs:"), std::string::npos, "}\n");
  const std::map<std::string, std::string> scenes = {
      {"incremental_potential", time_of("implicit_euler", 2e-3) + sliding},
      {"lcp_pgs", time_of("implicit_euler", 2e-3, ", stepper: lcp_pgs") + without_bonds},
      {"path_following", time_of("quasi_static", 1, ", stepper: {type: path_following, arc_speed: 0.02}") + snapping},
  };
  for (const auto& [stepper, entry] : Registry<Stepper>::kind().entries()) {
    if (entry.file.starts_with("tests/")) continue;
    INFO(stepper);
    REQUIRE(scenes.contains(stepper));  // a new stepper needs a scene
    CHECK(difference_after_resumption(scenes.at(stepper)) == "");
  }
}
