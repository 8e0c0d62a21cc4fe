// tack solve from the command line.
#include <catch2/catch.hpp>
#include <filesystem>

#include "framework/config/parse.hpp"
#include "framework/run/stored_step.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

const std::string impact = TACK_TEST_DATA "/problems/impact.problem";

}  // namespace

TEST_CASE("tack solve measures several solvers on a stored step, and keeps its minimum") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "impact.problem";
  fs::copy_file(impact, file);
  const ProgramResult first = run_tack(folder.path(), {"solve", "impact.problem", "--store-minimum", "--solver", "projected_newton", "--solver",
                                                       "{type: newton_pcg, tolerance: 0.01 mm/s}", "--solver", "{type: projected_newton, max_iterations: 1}"});
  INFO(first.out << first.err);
  CHECK(first.exit_code == 3);  // the last solver did not converge
  CHECK(contains(first.out, "impact.problem: 750 unknowns, step of 0.01 s; its minimum was found to 1e-10 m/s and stored"));
  CHECK(contains(first.out, "newton_pcg"));
  CHECK(contains(first.out, "iteration limit reached"));
  const StoredStep step(file.string());
  REQUIRE(step.has_minimum());
  const StoredSolve loose = step.solve({}), tight = step.solve(parse_string("{tolerance: 1e-5 mm/s}", "(test)"));
  CHECK(loose.converged);
  CHECK(loose.residual <= 1);
  CHECK(loose.iterations > 3);
  CHECK(loose.evaluations >= loose.iterations);
  CHECK(loose.cpu_seconds > 0);
  REQUIRE(loose.distance);
  REQUIRE(tight.distance);
  CHECK(*tight.distance < 1e-4 * *loose.distance);
  const ProgramResult again = run_tack(folder.path(), {"solve", "impact.problem"});
  CHECK(again.exit_code == 0);
  CHECK(contains(again.out, "its minimum is stored to 1e-10 m/s"));
}

TEST_CASE("a solve that runs out of wall time names the key and its value") {
  const StoredStep step(impact);
  CHECK(step.solve(parse_string("{time_limit: 1e-9}", "(test)")).status == "out of wall time (solver.time_limit: 1e-09 s)");
  const TemporaryFolder folder;
  write_file(folder.path() / "compare.yaml", "name: late\nproblems: [" + impact + "]\nrepeat: 1\ntolerances: [1 mm/s]\nsolvers: [{name: slow, solver: {time_limit: 1e-9}}]\n");
  const ProgramResult compared = run_tack(folder.path(), {"compare", "compare.yaml"});
  CHECK(compared.exit_code == 0);
  CHECK(contains(compared.out, "out of wall time (solver.time_limit: 1e-09 s)"));
  CHECK(contains(file_text(folder.path() / "results/late/compare.csv"), "out of wall time (solver.time_limit: 1e-09 s)"));
}

TEST_CASE("another solver of a stored step keeps the convergence criteria of its scene") {
  const StoredStep step(impact, {"solver.max_iterations=400"});
  CHECK_FALSE(step.has_minimum());
  const StoredSolve own = step.solve({}), other = step.solve(parse_string("newton_pcg", "(test)"));
  CHECK_FALSE(own.distance);
  CHECK(other.converged);
  CHECK((own.x - other.x).lpNorm<Eigen::Infinity>() < 5 * 0.01 * 0.001);  // tolerance 1 mm/s, step 10 ms
  CHECK_THROWS_WITH(step.solve(parse_string("newton_pgc", "(test)")), Catch::Contains("newton_pcg"));
}

TEST_CASE("commands for scenes name the commands for stored steps") {
  const TemporaryFolder folder;
  for (const char* command : {"run", "check"}) {
    const ProgramResult refused = run_tack(folder.path(), {command, impact});
    CHECK(refused.exit_code == 2);
    CHECK(contains(refused.err, "impact.problem: this is a stored step or a checkpoint of a run, not a scene; `tack solve`"));
  }
  write_file(folder.path() / "scene.yaml", tiny_scene);
  CHECK(contains(run_tack(folder.path(), {"solve", "scene.yaml"}).err, "tack run --dump-problem"));
  CHECK(contains(run_tack(folder.path(), {"solve", impact, "--store-minimum", "--set", "gravity=null"}).err, "leave --set away"));
}
