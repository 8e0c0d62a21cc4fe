#include "framework/compare/performance_profile.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/compare/plots.hpp"
#include "framework/compare/report.hpp"

using namespace tack;

namespace {

CompareRow row(const char* problem, const char* solver, double seconds, bool converged = true) {
  CompareRow r;
  r.problem = problem;
  r.solver = solver;
  r.tolerance = 1e-3;
  r.time_step = 0.01;
  r.wall_seconds = r.wall_min = r.wall_max = seconds;
  r.converged = converged;
  r.error_rms = r.error_max = 1e-6;
  r.relative_error = 1e-5;
  r.size = 0.1;
  return r;
}

// Solver a is twice as slow on the first task, b fails on the second, both fail on the third.
const std::vector<CompareRow> rows = {row("one", "a", 2), row("one", "b", 1), row("two", "a", 3), row("two", "b", 1, false),
                                      row("three", "a", 1, false), row("three", "b", 1, false)};

}  // namespace

TEST_CASE("a performance profile holds the ratios to the fastest time of each task", "[compare]") {
  const auto profiles = performance_profiles(rows);
  REQUIRE(profiles.size() == 2);
  CHECK(profiles[0].solver == "a");
  REQUIRE(profiles[0].ratios.size() == 3);
  CHECK(profiles[0].ratios[0] == 1);
  CHECK(profiles[0].ratios[1] == 2);
  CHECK(std::isinf(profiles[0].ratios[2]));  // tasks that no solver solves count
  CHECK(profiles[1].ratios[0] == 1);
  CHECK(std::isinf(profiles[1].ratios[1]));
}

TEST_CASE("a solver whose times overlap with those of the fastest counts as fastest", "[compare]") {
  std::vector<CompareRow> close = {row("one", "a", 1), row("one", "b", 1.1), row("one", "c", 1.3)};
  close[0].wall_max = 1.12;
  close[1].wall_min = 1.05;
  close[2].wall_min = 1.13;
  const CompareConfig config;
  const std::string report = compare_report(config, {{{"one", 0.01, 1e-10, 0, 0, 1, false, false, 1, ""}}, close, "", {}}, {}, 0);
  CHECK(report.find("| one | 1e-6 | a | 1e-03 | 0.01 | 1 | 0 | 0 | 1.0e-06 | b |") != std::string::npos);
  CHECK(report.find("| a | 1 | 1 | 1.00 | 0 | 1e-05 | 0 | 0 |\n| b | 1 | 1 | 1.10 |") != std::string::npos);
  CHECK(report.find("| c | 1 | 0 | 1.30 |") != std::string::npos);
}

TEST_CASE("errors below the noise floor have no rank and no point, and the floor is shown", "[compare]") {
  const auto with = [](const char* solver, double tolerance, double seconds, double error) {
    CompareRow r = row("one", solver, seconds);
    r.tolerance = tolerance;
    r.error_rms = error;
    r.error_max = 10 * error;  // the floor is compared with errors in its own norm
    r.floor = 3e-7;
    return r;
  };
  const ReferenceRow reference{"one", 0.01, 1e-10, 2e-6, 3e-7, 0.1, false, false, 1, ""};
  std::vector<CompareRow> some = {with("a", 1e-2, 1, 5e-6), with("b", 1e-2, 2, 4e-5), with("a", 1e-4, 3, 1e-7), with("b", 1e-4, 2.5, 1e-9)};
  const std::string report = compare_report({}, {{reference}, some, "", {}}, {}, 0);
  const char* const ranking = "| problem | error at most";  // the table's heading
  CHECK(report.find("| one | 0.01 | 1 | 0.1 | 1e-10 | 2.0e-06 | 3.0e-07 |") != std::string::npos);
  CHECK(report.find("| one | 1e-5 | a | 1e-02 | 0.01 | 1 | 0 | 0 | 5.0e-06 |") != std::string::npos);
  CHECK(report.find("| one | 1e-6 | b | 1e-04 | 0.01 | 2.5 | 0 | 0 | below 3.0e-07 |") != std::string::npos);
  CHECK(report.find("| one | 1e-7 ") == std::string::npos);
  CHECK(report.find("1.0e-09") == std::string::npos);
  CHECK(report.find(ranking) != std::string::npos);
  Plot plot = work_precision(some);
  REQUIRE(plot.curves.size() == 2);
  CHECK(plot.curves[0].points.size() == 1);
  CHECK(plot.curves[1].points.size() == 1);
  REQUIRE(plot.verticals.size() == 1);
  CHECK(plot.verticals[0].at == Approx(3e-6));  // of the size
  CHECK(plot.notes == std::vector<std::string>{"no point, as the error is below the noise floor: a at 0.0001 m/s, b at 0.0001 m/s"});
  // The line of a floor far left of all points would squeeze the points.
  std::vector<CompareRow> far = {with("a", 1e-2, 1, 5e-4), with("b", 1e-2, 2, 4e-3)};
  plot = work_precision(far);
  CHECK(plot.verticals.empty());
  CHECK(plot.notes == std::vector<std::string>{"the noise floor is 3e-06, further left"});
  // Without errors above the floor there is no ranking, and the report has the reason.
  some = {with("a", 1e-2, 1, 1e-7), with("b", 1e-2, 2, 1e-8)};
  const std::string noisy = compare_report({}, {{reference}, some, "", {}}, {}, 0);
  CHECK(noisy.find("- one: all errors are below the noise floor of 3.0e-07 m") != std::string::npos);
  CHECK(noisy.find(ranking) == std::string::npos);
  CHECK(work_precision(some).curves[0].points.empty());
  some = {row("one", "a", 1, false)};
  CHECK(compare_report({}, {{reference}, some, "", {}}, {}, 0).find("- one: no solver solved it.") != std::string::npos);
  ReferenceRow none = reference;
  none.tolerance = 0;
  CHECK(compare_report({}, {{none}, some, "", {}}, {}, 0).find("- one: there is no reference, so that errors are unknown.") != std::string::npos);
}

TEST_CASE("large errors of large scenes are ranked", "[compare]") {
  CompareRow far = row("one", "a", 1);
  far.error_rms = far.error_max = 300;
  const ReferenceRow reference{"one", 0.01, 1e-10, 0, 0, 1e4, false, false, 1, ""};
  CHECK(compare_report({}, {{reference}, {far}, "", {}}, {}, 0).find("| one | 1e3 | a |") != std::string::npos);
}

TEST_CASE("runs that come closer with smaller tolerances are inaccurate, others are on another branch", "[compare]") {
  const auto run = [](const char* solver, double tolerance, double error, const char* branch) {
    CompareRow r = row("one", solver, 1);
    r.tolerance = tolerance;
    r.error_max = error;
    r.branch = branch;
    return r;
  };
  std::vector<CompareRow> some = {run("a", 1e-1, 4e-3, "another"), run("a", 1e-3, 1e-5, "same"),
                                  run("b", 1e-1, 9e-3, "another"), run("b", 1e-3, 3e-3, "another"),
                                  run("c", 1e-1, 4e-3, "another"), run("c", 1e-3, 4.1e-3, "another"),
                                  run("d", 1e-1, 4e-3, "another")};
  some.back().single_step = true;
  classify_branches(some);
  const std::vector<std::string> expected = {"inaccurate", "same", "inaccurate", "inaccurate", "another", "another", "another"};
  for (size_t i = 0; i < some.size(); ++i) CHECK(some[i].branch == expected[i]);
}

TEST_CASE("a converged result with too large an error is not solved, and the limit is shown", "[compare]") {
  std::vector<CompareRow> some = {row("one", "a", 1), row("one", "b", 2), row("two", "a", 1), row("two", "b", 2)};
  for (CompareRow& r : some) r.single_step = true, r.branch = "same", r.error_limit = 1e-3;
  some[0].error_rms = 1e-3, some[0].error_max = 2.5e-3, some[0].relative_error = 0.025;
  CHECK(some[0].inaccurate());
  CHECK_FALSE(some[0].solved());
  CHECK(some[1].solved());
  const auto profiles = performance_profiles(some);
  CHECK(std::isinf(profiles[0].ratios[1]));
  CHECK(profiles[1].ratios[0] == 1);
  const std::string note = "failures by inaccuracy, relative error above 0.001 (error_limit): a at 0.001 m/s";
  CHECK(profile_plot(some).notes == std::vector<std::string>{note});
  const std::vector<std::string> notes = work_precision(some).notes;
  CHECK(std::find(notes.begin(), notes.end(), note) != notes.end());
  const ReferenceRow one{"one", 0.01, 1e-10, 0, 0, 0.1, false, false, 1, ""}, two{"two", 0.01, 1e-10, 0, 0, 0.1, false, false, 1, ""};
  const std::string report = compare_report({}, {{one, two}, some, "", {}}, {}, 0);
  CHECK(report.find("at most 0.001 (`error_limit`)") != std::string::npos);
  CHECK(report.find("| b | 2 | 1 |") != std::string::npos);
  CHECK(report.find("| a | 1 | 1 | 1.00 | 0 | 1e-05 | 0 | 1 |") != std::string::npos);
  CHECK(report.find("| one | a | 1e-03 | 0.01 | inaccurate: 2.5e-03 m from its minimum, 2.5e-02 of the size (error_limit: 0.001) |") != std::string::npos);
  // Without a limit, for other time steps than the reference's, the error is for the reader to judge.
  some[0].error_limit = CompareRow().error_limit;
  CHECK(some[0].solved());
}

TEST_CASE("profile plots show the fraction of tasks solved", "[compare]") {
  const Plot plot = profile_plot(rows);
  REQUIRE(plot.curves.size() == 2);
  const auto& a = plot.curves[0].points;
  CHECK(a.front() == std::pair<double, double>(1, 0));
  CHECK(a.back().second == Approx(2 / 3.0));
  CHECK(plot.curves[1].points.back().second == Approx(1 / 3.0));
  std::vector<CompareRow> failing = rows;
  failing.push_back(row("one", "never", 1, false));
  CHECK(profile_plot(failing).notes == std::vector<std::string>{"solved nothing: never"});
}

TEST_CASE(
    "work-precision points sum times over problems, and exist only where all of them are solved",
    "[compare]") {
  std::vector<CompareRow> some = {row("one", "a", 2), row("two", "a", 3), row("one", "b", 1),
                                  row("two", "b", 1)};
  some[1].error_rms = some[1].error_max = 1e-4;
  some[1].relative_error = 1e-3;
  const Plot plot = work_precision(some);
  REQUIRE(plot.curves.size() == 2);
  REQUIRE(plot.curves[0].points.size() == 1);
  CHECK(plot.curves[0].points[0].first == Approx(1e-4));  // the mean of 1e-5 and 1e-3
  CHECK(plot.curves[0].points[0].second == 5);
  REQUIRE(plot.curves[1].points.size() == 1);
  CHECK(plot.curves[1].points[0].second == 2);
  CHECK(plot.notes.empty());
  some.push_back(row("three", "a", 1, false));
  some.push_back(row("three", "b", 1, false));
  CHECK(work_precision(some).notes.front() == "omitted, as no solver solves it: three");
  CHECK(work_precision(some).curves[0].points == plot.curves[0].points);
  some.push_back(row("two", "a", 1, false));
  some.back().tolerance = 1e-4;
  CHECK(work_precision(some).notes.back() == "failed at some tolerances: a (two)");
}

TEST_CASE("a method that fails on a problem keeps its curve, over the problems that all solve",
          "[compare]") {
  std::vector<CompareRow> some = {row("one", "a", 2), row("two", "a", 3), row("one", "b", 1),
                                  row("two", "b", 1, false)};
  Plot plot = work_precision(some);
  REQUIRE(plot.curves.size() == 2);
  REQUIRE(plot.curves[1].points.size() == 1);
  CHECK(plot.curves[0].points[0].second == 2);  // without problem two
  CHECK(plot.curves[1].points[0].second == 1);
  CHECK(plot.notes ==
        std::vector<std::string>{"1 of 2 problems count: those that all methods with a curve solve",
                                 "left out, with those that fail on it: two (b)"});
  some.push_back(row("one", "never", 1, false));
  some.push_back(row("two", "never", 1, false));
  plot = work_precision(some);
  CHECK(plot.curves[0].points[0].second == 2);  // what solves nothing does not empty the picture
  CHECK(plot.curves[2].points.empty());
  CHECK(plot.notes.back() == "solved at no tolerance: never");
}

TEST_CASE("work-precision plots show the spread of repetitions", "[compare]") {
  std::vector<CompareRow> some = {row("one", "a", 2)};
  some[0].wall_min = 1.9;
  some[0].wall_max = 2.4;
  const Plot plot = work_precision(some);
  REQUIRE(plot.curves[0].spread.size() == 1);
  CHECK(plot.curves[0].spread[0].first == Approx(1.9));
  CHECK(plot.curves[0].spread[0].second == Approx(2.4));
}
