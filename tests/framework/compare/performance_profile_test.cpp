#include "framework/compare/performance_profile.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "framework/compare/plots.hpp"

using namespace tack;

namespace {

CompareRow row(const char* problem, const char* solver, double seconds, bool converged = true) {
  CompareRow r;
  r.problem = problem;
  r.solver = solver;
  r.tolerance = 1e-3;
  r.time_step = 0.01;
  r.wall_seconds = seconds;
  r.converged = converged;
  r.error_rms = r.error_max = 1e-6;
  r.relative_error = 1e-5;
  return r;
}

// a is twice as slow on the first task, b fails on the second, nobody does the third.
const std::vector<CompareRow> rows = {row("one", "a", 2), row("one", "b", 1), row("two", "a", 3), row("two", "b", 1, false),
                                      row("three", "a", 1, false), row("three", "b", 1, false)};

}  // namespace

TEST_CASE("a performance profile is the ratios to the fastest of each task", "[compare]") {
  const auto profiles = performance_profiles(rows);
  REQUIRE(profiles.size() == 2);
  CHECK(profiles[0].solver == "a");
  REQUIRE(profiles[0].ratios.size() == 3);
  CHECK(profiles[0].ratios[0] == 1);
  CHECK(profiles[0].ratios[1] == 2);
  CHECK(std::isinf(profiles[0].ratios[2]));  // what nobody solves stays
  CHECK(profiles[1].ratios[0] == 1);
  CHECK(std::isinf(profiles[1].ratios[1]));
}

TEST_CASE("profiles are drawn as the part of the tasks done", "[compare]") {
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

TEST_CASE("work and precision add up over problems, and need all of them", "[compare]") {
  std::vector<CompareRow> some = {row("one", "a", 2), row("two", "a", 3), row("one", "b", 1), row("two", "b", 1, false)};
  some[1].error_rms = some[1].error_max = 1e-4;
  some[1].relative_error = 1e-3;
  const Plot plot = work_precision(some);
  REQUIRE(plot.curves.size() == 2);
  REQUIRE(plot.curves[0].points.size() == 1);
  CHECK(plot.curves[0].points[0].first == Approx(1e-4));  // the mean of 1e-5 and 1e-3
  CHECK(plot.curves[0].points[0].second == 5);
  CHECK(plot.curves[1].points.empty());
  CHECK(plot.notes == std::vector<std::string>{"no tolerance at which all problems were solved: b"});
}

TEST_CASE("work and precision show the spread of repetitions", "[compare]") {
  std::vector<CompareRow> some = {row("one", "a", 2)};
  some[0].wall_spread = 0.5;
  const Plot plot = work_precision(some);
  REQUIRE(plot.curves[0].spread.size() == 1);
  CHECK(plot.curves[0].spread[0].first == Approx(1.75));
  CHECK(plot.curves[0].spread[0].second == Approx(2.25));
}
