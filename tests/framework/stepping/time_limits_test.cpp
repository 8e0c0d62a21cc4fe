// Limits of wall time: they end long runs, name the cause, and change nothing else.
#include <catch2/catch.hpp>
#include <chrono>

#include "geometry/errors.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A ball that is shot at a thin plate, so fine that the plate still blocks it when a clock has run out, on slow machines and fast ones.
std::string shot(const std::string& time, const std::string& solver) {
  return "time: {step: 0.01, duration: 0.05" + time + "}\n"
         "solver: {type: projected_newton, tolerance: 1e-14" + solver + "}\n"
         "objects:\n"
         "  - {name: plate, shape: {type: box, size: [0.4, 0.004, 0.4], cells: [8, 1, 8]}, place: {translate: [0, -0.002, 0]},\n"
         "     energies: [{type: neo_hookean, young: 1e7}], motion: [{type: fixed, select: {type: face, direction: [1, 0, 0]}}]}\n"
         "  - {name: ball, shape: {type: sphere, radius: 0.05, cells: 16}, place: {translate: [0, 0.12, 0]},\n"
         "     velocity: [0, -1000, 0], energies: [{type: neo_hookean, young: 1e6}]}\n"
         "contact: {distance: 1 mm}\n";
}

// A tolerance that is never reached.
std::string endless(const std::string& time, const std::string& solver) {
  return shot(time, ", max_iterations: 1000000" + solver);
}

// The million iterations take hours. The bound is for a machine on which much else runs.
constexpr double long_after_limit = 30 * TACK_PATIENCE;  // s

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

TEST_CASE("time.wall_limit ends a run within a solve, and names the blocking primitives", "[limits]") {
  TestRun run(endless(", wall_limit: 0.5 s", ""));
  const Stopwatch watch;
  CHECK_THROWS_WITH(run.step(), Catch::Contains("time.wall_limit: 0.5 s") && Catch::Contains("step 1 at t = 0 s") &&
                                    Catch::Contains("out of wall time (time.wall_limit: 0.5 s) after") &&
                                    Catch::Contains("the last step was cut to ") && Catch::Contains("of 'ball'") &&
                                    Catch::Contains("of 'plate'") && Catch::Contains(" m apart"));
  CHECK(watch.seconds() < long_after_limit);
  CHECK(run.state().step == 0);
  CHECK((run.state().x == run.world->start.x));
  CHECK(run.warnings == std::vector<Warning>{});  // no step cutback
  CHECK_THROWS_AS(run.step(), SimulationError);  // from the start, too
}

TEST_CASE("a failed solve names the blocking primitives", "[limits]") {
  TestRun run(shot(", max_cutbacks: 0", ", max_iterations: 1"));  // the flight, which the plate ends
  CHECK_THROWS_WITH(run.step(), Catch::Contains("the last step was cut to ") && Catch::Contains("of 'ball'") &&
                                    Catch::Contains("of 'plate'") && Catch::Contains(" m apart"));
}

TEST_CASE("a solve that exceeds solver.time_limit fails", "[limits]") {
  TestRun run(endless(", max_cutbacks: 2", ", time_limit: 100 ms"));
  const Stopwatch watch;
  CHECK_THROWS_WITH(run.step(), Catch::Contains("failed with h = 0.0025 s (out of wall time (solver.time_limit: 0.1 s)"));
  CHECK(watch.seconds() < long_after_limit);
  REQUIRE(run.warnings.size() == 2);
  CHECK_THAT(first_text(run.warnings, WarningKind::step_cutback), Catch::Contains("solver.time_limit: 0.1 s") && Catch::Contains("the last step was cut to ") &&
                                  Catch::Contains("h halved to 0.005 s (1/2 of the step)"));
  CHECK_THAT(run.warnings[1].text, Catch::Contains("h halved to 0.0025 s (1/4 of the step)"));
}

TEST_CASE("limits that are not reached change no bit", "[limits]") {
  const auto end_of = [](const std::string& time, const std::string& solver) {
    TestRun run("time: {step: 0.01, duration: 0.03" + time + "}\nsolver: {type: projected_newton" + solver + "}\n"
                   "gravity: [0, -9.81, 0]\nobjects:\n"
                   "  - {name: floor, shape: {type: box, size: [1, 0.2, 1]}, place: {translate: [0, -0.1, 0]}, motion: [fixed]}\n"
                   "  - {name: block, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]},\n"
                   "     place: {axis: [0.2, 0, 1], angle: 0.1, translate: [0, 0.112, 0]}, velocity: [0.3, -1, 0],\n"
                   "     energies: [{type: neo_hookean, young: 1e5}]}\ncontact: {distance: 2 mm}\n");
    while (!run.stepper.finished()) run.step();
    return run.state().x;
  };
  const VecX without = end_of("", "");
  CHECK((end_of(", wall_limit: 1 h", ", time_limit: 30 min") == without));
  CHECK((end_of("", ", check_iterates: true") == without));
}
