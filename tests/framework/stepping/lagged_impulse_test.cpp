// What friction owes from step to step, and through checkpoints. That impacts give mu times their normal impulse:
// impact_test.cpp.
#include "framework/stepping/lagged_impulse.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/output/state_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A block that slides over a floor, and bounces a little.
std::string sliding(const std::string& integrator) {
  return fmt::format(
      "time: {{step: 4 ms, duration: 1, integrator: {}}}\n"
      "solver: {{type: projected_newton, linear: cholmod, tolerance: 0.1 mm/s}}\n"
      "objects:\n"
      "  - {{name: floor, shape: {{type: box, size: [2, 0.02, 0.5], cells: [9, 1, 3]}},\n"
      "     place: {{translate: [0.5, -0.01, 0]}}, motion: [fixed]}}\n"
      "  - {{name: block, shape: {{type: box, size: [0.2, 0.05, 0.2], cells: [4, 1, 4]}},\n"
      "     place: {{translate: [0, 0.02595, 0]}}, velocity: [2, -0.01, 0], energies: [{{type: neo_hookean, young: 2 MPa, poisson: 0.3}}]}}\n"
      "gravity: [0, -9.81, 0]\n"
      "contact: {{distance: 1 mm, friction: {{mu: 0.3}}}}\n",
      integrator);
}

void step(TestRun& run) {
  constexpr std::array<double, 5> sizes = {1, 0.25, 0.25, 1, 0.5};  // of the steps, in turn, in those of the scene
  const double h = 4e-3 * sizes[run.state().step % sizes.size()];
  const Attempt attempt = run.stepper.solve(h);
  REQUIRE(run.stepper.verdict(attempt).empty());
  run.stepper.commit(attempt.x, h);
}

}  // namespace

TEST_CASE("what friction owes goes through a checkpoint bit for bit", "[stepping][friction]") {
  constexpr int steps = 14;
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
    INFO(integrator);
    const TemporaryFolder folder;
    TestRun whole(sliding(integrator));
    std::vector<State> states;
    for (int i = 0; i < steps; ++i) {
      step(whole);
      states.push_back(whole.state());
    }
    const State& end = states.back();
    const auto gone_on = [&](const State& from) {
      TestRun rest(sliding(integrator));
      rest.simulation.start_from(from);
      while (rest.state().step < end.step) step(rest);
      return rest.state();
    };
    int depends = 0;  // on what is owed after how many steps
    for (int i = 0; i + 1 < steps; ++i) {
      StateFile file;
      file.kind = StateFile::Kind::checkpoint;
      file.state = states[i];
      write_state_file(folder.path() / "middle", file);
      const State resumed = gone_on(read_state_file(folder.path() / "middle", StateFile::Kind::checkpoint).state);
      CHECK((resumed.x == end.x && resumed.v == end.v && resumed.history == end.history));
      CHECK(resumed.acted_before == end.acted_before);
      State without = states[i];
      without.history.erase(owed_friction_name);
      depends += gone_on(without).x != end.x;
    }
    CHECK(depends > 0);
  }
}
