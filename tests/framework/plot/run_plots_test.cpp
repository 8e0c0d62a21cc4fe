// Plots of runs as data: the curves and their contents.
#include "framework/plot/run_plots.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/program.hpp"

using namespace tack;

namespace {

PlottedRun run_named(const std::string& name, double factor) {
  PlottedRun run{name, {{"time", "newton_iterations", "seconds_assembly", "seconds_linear_solve"}, {{0.1, 3, 1, 3}, {0.2, 5, 2, 2}}},
                 {{"time", "gap", "force"}, {{0, 1e-3, 0}, {0.1, 2e-3, 5 * factor}, {0.2, 3e-3, 1}}}, {}, {}, {{"gap", "m"}, {"force", "1"}}};
  return run;
}

}  // namespace

TEST_CASE("a plot of a probe over another has a curve for each run with both", "[plot]") {
  PlottedRun without{"c", {}, {{"time", "gap"}, {{0, 1}}}, {}, {}, {}};
  const Plot plot = probe_curves({run_named("a", 1), run_named("b", 2), without}, "gap", "force");
  REQUIRE(plot.curves.size() == 2);
  CHECK(plot.curves[1].title == "b");
  CHECK(plot.curves[1].points == std::vector<std::pair<double, double>>{{1e-3, 0}, {2e-3, 10}, {3e-3, 1}});
  CHECK(plot.x_label == "gap");
  CHECK(plot.x_unit == "m");
  CHECK(plot.y_label == "force");
  CHECK(within(plot, 1.5e-3, 2e-3).curves[1].points == std::vector<std::pair<double, double>>{{2e-3, 10}});
  REQUIRE(plot.notes.size() == 1);
  CHECK(contains(plot.notes[0], "c"));
  CHECK_THROWS_WITH(probe_curves({run_named("a", 1)}, "gap", "forse"), Catch::Contains("did you mean 'force'"));
  CHECK_THROWS_WITH(probe_curves({run_named("a", 1)}, "gab", "force"), Catch::Contains("did you mean 'gap'"));
}

TEST_CASE("bars of phases: seconds per step and percentages", "[plot]") {
  const auto bars = phase_bars({run_named("a", 1)});
  REQUIRE(bars);
  CHECK(bars->segments == std::vector<std::string>{"assembly", "linear_solve"});
  CHECK(bars->heights == std::vector<std::vector<double>>{{1.5, 2.5}});
  const StackedBars shares = percentages_of(*bars);
  CHECK(shares.heights[0][0] == Approx(37.5));
  CHECK(shares.heights[0][0] + shares.heights[0][1] == Approx(100));
  CHECK(shares.top == 100);
}

TEST_CASE("laws: a curve for each pair, clipped where repulsion exceeds the peak of adhesion", "[plot]") {
  PlottedRun run = run_named("a", 1);
  run.laws = {{"pair", "gap", "traction", "barrier", "adhesion"},
              {{"a - b", "0.0001", "-9000", "-9100", "100"}, {"a - b", "0.001", "1000", "0", "1000"}, {"a - c", "0.001", "500", "0", "500"}}};
  const Plot laws = run_curves({run}).at("laws");
  REQUIRE(laws.curves.size() == 2);
  CHECK(laws.curves[0].points == std::vector<std::pair<double, double>>{{1e-3, 1e3}});
  CHECK(laws.curves[1].title == "a - c");
  CHECK(run_curves({run, run}).count("laws") == 0);
}
