// Accumulated impulse error of friction, from step to step and through checkpoints; its first
// steps. See impact_test.cpp for the ratio mu of impulses in impacts.
#include "framework/stepping/lagged_impulses.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/output/state_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A block that slides over a floor at 2 m/s and bounces a little: its gap is about that at rest, or half the contact distance,
// from which it would rebound at 0.2 m/s without damping.
enum class Start { at_rest, inside };
std::string sliding(const std::string& integrator, double h, Start start, const std::string& more = "") {
  return fmt::format(
      "time: {{step: {}, duration: 0.3, integrator: {}}}\n"
      "solver: {{type: projected_newton, linear: cholmod, tolerance: 0.1 mm/s}}\n"
      "objects:\n"
      "  - {{name: floor, shape: {{type: box, size: [4, 0.05, 1]}}, place: {{translate: [0, -0.025, 0]}}, motion: [fixed]}}\n"
      "  - {{name: block, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}}, place: {{translate: [-1, {}, 0]}},\n"
      "     velocity: [2, 0, 0], energies: [{{type: neo_hookean, young: 1 MPa, poisson: 0.4, density: 1000}}]{}}}\n"
      "gravity: [0, -9.81, 0]\n"
      "contact: {{distance: 1 mm, friction: {{mu: 0.5, eps_v: 0.1 mm/s}}}}\n",
      h, integrator, start == Start::inside ? 0.0505 : 0.05095, more);
}

void step(TestRun& run, double h) {
  const SolveResult result = run.stepper.solve(h);
  REQUIRE(run.stepper.validate(result).fault.empty());
  run.stepper.commit(result.x, h);
}

Vec3 mean(const TestRun& run, const VecX& rows) {
  Vec3 sum = Vec3::Zero();
  for (int b = 0; b < run.world->dofs.block_count(); ++b) {
    const int v = run.world->dofs.vertex_of_block(b);
    sum += run.world->mass(v) * vertex(rows, v);
  }
  return sum;  // the block has 1 kg
}

}  // namespace

TEST_CASE("the accumulated impulse error of friction is restored bit for bit from a checkpoint", "[stepping][friction]") {
  constexpr std::array<double, 5> sizes = {1, 0.25, 0.25, 1, 0.5};  // of the steps, in turn, in those of the scene
  constexpr int steps = 14;
  for (const Start start : {Start::at_rest, Start::inside})
    for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
      INFO(integrator << (start == Start::inside ? ", inside the barrier" : ""));
      const std::string scene = sliding(integrator, 4e-3, start);
      const TemporaryFolder folder;
      const auto next = [&](TestRun& run) { step(run, 4e-3 * sizes[run.state().step % sizes.size()]); };
      TestRun uninterrupted(scene);
      std::vector<State> states;
      for (int i = 0; i < steps; ++i) {
        next(uninterrupted);
        states.push_back(uninterrupted.state());
      }
      const State& end = states.back();
      const auto gone_on = [&](const State& from) {
        TestRun rest(scene);
        rest.simulation.start_from(from);
        while (rest.state().step < end.step) next(rest);
        return rest.state();
      };
      int depends = 0;  // number of steps whose impulse error matters
      for (int i = 0; i + 1 < steps; ++i) {
        StateFile file;
        file.kind = StateFile::Kind::checkpoint;
        file.state = states[i];
        write_state_file(folder.path() / "middle", file);
        const State resumed = gone_on(read_state_file(folder.path() / "middle", StateFile::Kind::checkpoint).state);
        CHECK((resumed.x == end.x && resumed.v == end.v && resumed.history == end.history));
        CHECK(resumed.contact_time_before == end.contact_time_before);
        State without = states[i];
        without.history.erase(friction_account_name);
        depends += gone_on(without).x != end.x;
      }
      CHECK(depends > 0);
    }
}

// Friction is mu times the impulse that stops the fall and accelerates the block upwards. With steps of 0.16 ms and lag
// iterations in each, the block slides 0.3786 m.
TEST_CASE("a block that starts inside a barrier slides as far as friction by its normal impulses allows", "[stepping][friction]") {
  const std::map<std::string, std::vector<double>> steps = {
      {"implicit_euler", {0.02, 0.01, 0.0025, 0.000625}}, {"bdf2", {0.01, 0.0025}}, {"newmark", {0.01, 0.0025}}};
  for (const auto& [integrator, sizes] : steps)
    for (const double h : sizes) {
      INFO(integrator << " h " << h << " s");
      TestRun run(sliding(integrator, h, Start::inside));
      const Vec3 start = mean(run, run.state().x);
      int again = 0;
      while (!run.stepper.finished()) {
        const StepReport report = run.step();
        if (report.lag_iterations > 1) ++again;
        CHECK(report.lag_iterations <= (report.time < 0.05 ? 10 : 1));
      }
      const Vec3 velocity = mean(run, run.state().v);
      CHECK((mean(run, run.state().x) - start).x() == Approx(0.3786).epsilon(0.05));
      CHECK((2 - velocity.x()) / (0.5 * (9.81 * 0.3 + velocity.y())) == Approx(1).epsilon(0.05));
      CHECK(again > 0);
      CHECK(again < 10);
      CHECK(run.warnings.empty());
    }
}

TEST_CASE("a start at rest, or without contact, needs no further solves for friction", "[stepping][friction]") {
  for (const std::string placement : {"", ", place: {translate: [-1, 0.06, 0]}"}) {
    const std::string scene = sliding("implicit_euler", 0.005, Start::at_rest);
    const size_t at = scene.find(", place: {translate: [-1, ");
    TestRun run(placement.empty() ? scene : scene.substr(0, at) + placement + scene.substr(scene.find("}", at) + 1));
    for (int i = 0; i < 30; ++i) CHECK(run.step().lag_iterations == 1);
    CHECK(run.warnings.empty());
  }
}

// The block is pressed evenly in many small steps, then lifted within a large one, in which lagged friction still acts.
TEST_CASE("friction applied far in excess of the normal impulse is warned of once", "[stepping][friction]") {
  TestRun run(
      "time: {step: 8 ms, duration: 0.08}\n"
      "solver: {type: projected_newton, linear: cholmod, tolerance: 0.1 mm/s}\n"
      "objects:\n"
      "  - {name: floor, shape: {type: box, size: [2, 0.02, 0.3]}, place: {translate: [0.5, -0.01, 0]}, motion: [fixed]}\n"
      "  - {name: block, shape: {type: box, size: [0.2, 0.05, 0.1], cells: [4, 1, 2]}, place: {translate: [0, 0.025943376, 0]},\n"
      "     velocity: [2, 0, 0], energies: [{type: neo_hookean, young: 10 MPa, poisson: 0.3}],\n"
      "     loads: [{type: body_force, value: [0, 1, 0], ramp: [[0, -10], [0.04, -10], [0.041, 40]]}]}\n"
      "contact: {distance: 1 mm, barrier: {type: clamped_log, stiffness: 50 kPa}, friction: {mu: 0.5}}\n");
  for (int i = 0; i < 40; ++i) step(run, 1e-3);
  while (!run.stepper.finished()) run.step();
  CHECK_THAT(only_text(run.warnings, WarningKind::friction_impulse), Catch::Contains("'floor' and 'block'"));
}
