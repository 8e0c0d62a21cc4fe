// Solves of a suite that end without a result, and scores.
#include <catch2/catch.hpp>

#include "framework/suite/leaderboard.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// Runs a shell script in place of the program for two solves, and returns their rows.
std::vector<SuiteRow> rows_of(const std::string& script) {
  const TemporaryFolder folder;
  const fs::path program = folder.path() / "program";
  write_file(program, "#!/bin/sh\n" + script + "\n");
  fs::permissions(program, fs::perms::owner_all);
  SuiteSettings settings;
  settings.problems = {"one.problem"};
  settings.solvers = {"first", "second"};
  settings.cpu_limit = 1;
  return run_suite(settings, program.string(), folder.path(), [](const SuiteResult&, const SuiteRow&) {}).rows;
}

SuiteRow row_of(const std::string& solver, SuiteOutcome outcome, double seconds, const std::string& minimum = "same") {
  SuiteRow row;
  row.solver = solver;
  row.outcome = outcome;
  row.seconds = seconds;
  row.minimum = minimum;
  return row;
}

}  // namespace

TEST_CASE("a crash of one solve is its outcome and ends no other", "[suite]") {
  const std::vector<SuiteRow> crashed = rows_of("[ $4 = second ] && exit 2; kill -SEGV $$");
  REQUIRE(crashed.size() == 2);
  CHECK(crashed[0].outcome == SuiteOutcome::crashed);
  CHECK(contains(crashed[0].status, "ended by signal 11"));
  CHECK(crashed[1].outcome == SuiteOutcome::refused);
  const std::vector<SuiteRow> refused = rows_of("echo 'error: no such solver' >&2; exit 2");
  CHECK(refused[0].outcome == SuiteOutcome::refused);
  CHECK(refused[0].status == "no such solver");
  CHECK(rows_of("echo 'error: nothing holds the body' >&2; exit 3")[1].outcome == SuiteOutcome::failed);
  CHECK(rows_of("exit 7")[0].outcome == SuiteOutcome::crashed);
}

TEST_CASE("results are judged by convergence, the Newton direction and intersections", "[suite]") {
  const auto outcome = [](const std::string& result) {
    const std::vector<SuiteRow> rows = rows_of("while [ $1 != --json ]; do shift; done; echo '{\"unknowns\": 3, \"solves\": [" + result + "]}' > $2");
    REQUIRE(rows.size() == 2);
    return rows[0].outcome;
  };
  CHECK(outcome("{\"converged\": true, \"status\": \"converged\", \"cpu_seconds\": 0.5, \"intersections\": 0, \"judged_residual\": 2}") == SuiteOutcome::solved);
  CHECK(outcome("{\"converged\": true, \"cpu_seconds\": 0.5, \"intersections\": 0, \"judged_residual\": 1e3}") == SuiteOutcome::inexact);
  CHECK(outcome("{\"converged\": true, \"cpu_seconds\": 0.5, \"intersections\": 2}") == SuiteOutcome::intersects);
  CHECK(outcome("{\"converged\": true, \"cpu_seconds\": 1.5, \"intersections\": 0}") == SuiteOutcome::time_limit);
  CHECK(outcome("{\"converged\": false, \"cpu_seconds\": 0.5, \"intersections\": 0}") == SuiteOutcome::failed);
}

TEST_CASE("scores order solvers by solved tasks, and failures count twice the limit", "[suite]") {
  const std::vector<SuiteRow> rows = {row_of("slow", SuiteOutcome::solved, 3),  row_of("slow", SuiteOutcome::solved, 5, "another"),
                                      row_of("fast", SuiteOutcome::solved, 1),  row_of("fast", SuiteOutcome::crashed, 1),
                                      row_of("other", SuiteOutcome::solved, 1), row_of("other", SuiteOutcome::solved, 1)};
  const std::vector<SolverScore> scores = scores_of(rows, 10);
  REQUIRE(scores.size() == 3);
  CHECK(scores[0].solver == "other");
  CHECK(scores[1].solver == "slow");
  CHECK(scores[1].penalized_seconds == 4);
  CHECK(scores[1].other_minima == 1);
  CHECK(scores[2].solver == "fast");
  CHECK(scores[2].solved() == 1);
  CHECK(scores[2].penalized_seconds == 10.5);
  CHECK(contains(score_table(scores), "fast"));
}
