// tack suite from the command line: the small problems of the shipped suite.
#include <catch2/catch.hpp>

#include "framework/output/csv.hpp"
#include "framework/suite/leaderboard.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t small_file = 20'000;  // bytes

// Returns the small problems of the shipped suite, the smallest first.
std::vector<std::string> small_problems(size_t count) {
  std::vector<std::pair<std::uintmax_t, std::string>> files;
  for (const std::string& file : problem_files({TACK_SOURCE_DIR "/experiments/suite"}))
    if (fs::file_size(file) < small_file) files.emplace_back(fs::file_size(file), file);
  std::sort(files.begin(), files.end());
  REQUIRE(files.size() >= count);
  std::vector<std::string> paths;
  for (size_t i = 0; i < count; ++i) paths.push_back(files[i].second);
  return paths;
}

struct Leaderboard {
  explicit Leaderboard(const fs::path& file) : table(read_csv_texts(file)) {}
  std::string cell(size_t row, const std::string& column) const {
    const auto at = std::find(table.columns.begin(), table.columns.end(), column);
    REQUIRE(at != table.columns.end());
    return table.rows[row][static_cast<size_t>(at - table.columns.begin())];
  }
  double number(size_t row, const std::string& column) const {
    const std::optional<double> value = csv_number(cell(row, column));
    INFO(column << " of row " << row << ": " << cell(row, column));
    REQUIRE(value);
    return *value;
  }

  CsvTexts table;
};

}  // namespace

TEST_CASE("tack suite solves its problems with all solvers and writes a leaderboard", "[suite]") {
  const TemporaryFolder folder;
  const std::vector<std::string> problems = small_problems(4);
  Arguments arguments{"suite", "-q", "-o", "out", "--solver", "projected_newton", "--solver", "{type: newton_pcg}", "--solver",
                      "{type: projected_newton, max_iterations: 1}"};
  arguments.insert(arguments.end(), problems.begin(), problems.end());
  const ProgramResult result = run_tack(folder.path(), arguments);
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(contains(result.out, "PAR2 [s]"));
  const Leaderboard board(folder.path() / "out/leaderboard.csv");
  CHECK(board.table.columns == std::vector<std::string>{"problem", "solver", "tolerance_scale", "outcome", "status", "iterations", "evaluations", "linear_solves",
                                                         "seconds", "wall_seconds", "residual", "judged_residual", "distance", "error", "minimum", "energy_gap",
                                                         "intersections"});
  REQUIRE(board.table.rows.size() == 3 * problems.size());
  for (size_t row = 0; row < board.table.rows.size(); ++row) {
    INFO(board.cell(row, "problem") << ", " << board.cell(row, "solver"));
    CHECK(board.number(row, "intersections") == 0);
    CHECK(board.number(row, "seconds") > 0);
    if (row % 3 == 2) {
      CHECK(board.cell(row, "outcome") == "failed");
      CHECK(board.cell(row, "status") == "iteration limit reached");
      CHECK(board.number(row, "iterations") <= 3);  // one per minimisation; friction repeats it
      continue;
    }
    CHECK(board.cell(row, "outcome") == "solved");
    CHECK(board.cell(row, "status") == "converged");
    CHECK(board.number(row, "iterations") >= 1);
    CHECK(board.number(row, "residual") <= 1);
    CHECK(board.number(row, "judged_residual") <= judged_residual_max);
    CHECK(board.number(row, "error") < 0.1);
    if (board.cell(row, "minimum") == "same") CHECK(board.number(row, "distance") < 0.1);
  }
  const nlohmann::json json = read_json(folder.path() / "out/leaderboard.json");
  CHECK(json["complete"] == true);
  CHECK(json["cpu_limit"] == 20);
  CHECK(json["provenance"]["threads"] == 1);
  REQUIRE(json["problems"].size() == problems.size());
  CHECK(json["problems"][0]["unknowns"] > 0);
  CHECK(json["problems"][0]["minimum_tolerance"] > 0);
  REQUIRE(json["scores"].size() == 3);
  CHECK(json["scores"][2]["solver"] == "{type: projected_newton, max_iterations: 1}");
  CHECK(json["scores"][2]["failed"] == problems.size());
  CHECK(json["scores"][2]["penalized_seconds"] == 40);
  CHECK_FALSE(fs::exists(folder.path() / "out/solves"));
}

TEST_CASE("a solve of a suite ends at its limit of processor time, and tighter tolerances have smaller errors", "[suite]") {
  const TemporaryFolder folder;
  const std::string problem = small_problems(1).front();
  REQUIRE(run_tack(folder.path(), {"suite", problem, "-q", "-o", "late", "--solver", "{type: gradient_descent, tolerance: 1e-9 mm/s}", "--cpu-limit", "0.2"}).exit_code == 0);
  const Leaderboard late(folder.path() / "late/leaderboard.csv");
  REQUIRE(late.table.rows.size() == 1);
  CHECK(late.cell(0, "outcome") == "time limit");
  CHECK(late.number(0, "iterations") > 1);
  CHECK(late.number(0, "seconds") < 2);
  CHECK(late.number(0, "intersections") == 0);
  REQUIRE(run_tack(folder.path(), {"suite", problem, "-q", "-o", "two", "--solver", "projected_newton", "--tolerance-scale", "1", "--tolerance-scale", "1e-3"}).exit_code == 0);
  const Leaderboard two(folder.path() / "two/leaderboard.csv");
  REQUIRE(two.table.rows.size() == 2);
  CHECK(two.cell(1, "outcome") == "solved");
  CHECK(two.number(1, "error") <= two.number(0, "error"));
  CHECK(two.number(1, "iterations") >= two.number(0, "iterations"));
}

TEST_CASE("a solve of a suite that ends before prescribed vertices are at their targets has no result", "[suite]") {
  const TemporaryFolder folder;
  REQUIRE(run_tack(folder.path(), {"suite", TACK_SOURCE_DIR "/experiments/suite/grains.problem", "-q", "-o", "out", "--solver", "anderson", "--cpu-limit", "0.2"}).exit_code == 0);
  const Leaderboard board(folder.path() / "out/leaderboard.csv");
  REQUIRE(board.table.rows.size() == 1);
  CHECK(board.cell(0, "outcome") == "time limit");
  CHECK(board.cell(0, "intersections").empty());
  CHECK(board.cell(0, "distance").empty());
}

TEST_CASE("tack suite refuses paths without problems and problems of one name", "[suite]") {
  const TemporaryFolder folder;
  CHECK(contains(run_tack(folder.path(), {"suite", "nowhere"}).err, "nowhere: there is no such file or folder"));
  fs::create_directory(folder.path() / "empty");
  CHECK(contains(run_tack(folder.path(), {"suite", "empty"}).err, "--dump-problem hardest=1"));
  const std::string problem = small_problems(1).front();
  fs::copy_file(problem, folder.path() / fs::path(problem).filename());
  CHECK(contains(run_tack(folder.path(), {"suite", problem, fs::path(problem).filename()}).err, "have one name"));
}
