#include "framework/batch/batch_plots.hpp"

#include <catch2/catch.hpp>

#include "framework/batch/batch_description.hpp"
#include "framework/plot/run_plots.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;

namespace {

// Two bases of one case each, and plots.
BatchPlan plan_with(const TemporaryFolder& folder, const std::string& plots) {
  write_file(folder.path() / "tiny.yaml", tiny_scene);
  write_file(folder.path() / "batch.yaml",
             "name: b\nbases:\n  - {name: one, file: tiny.yaml}\n  - {name: two, file: tiny.yaml, set: [time.duration=0.02 s]}\nplots:\n" + plots);
  return plan_of(load_batch(folder.path() / "batch.yaml", {}), "program");
}

PlottedRun run_named(const std::string& name) {
  PlottedRun run;
  run.name = name;
  run.probes = {{"time", "gap", "pull"}, {{0, 1e-3, 5}, {1, 2e-3, 7}}};
  run.steps = {{"step", "time", "newton_iterations"}, {{1, 0.1, 4}, {2, 0.2, 6}}};
  run.units = {{"gap", "m"}, {"pull", "N"}};
  return run;
}

}  // namespace

TEST_CASE("a batch's own plots are curves of its runs, by probes or steps", "[batch][plot]") {
  const TemporaryFolder folder;
  const BatchPlan plan = plan_with(folder,
                                   "  - name: figure\n    curves:\n      - {base: one, x: gap, y: pull, title: first}\n      - {base: two, x: gap, y: pull}\n"
                                   "  - {name: steps, y_label: iterations, curves: [{base: two, y: newton_iterations}]}\n");
  std::map<std::string, PlottedRun> runs{{plan.cases[0].name, run_named("a")}};
  const Plot half = curves_of(plan.plots[0], plan, runs);
  REQUIRE(half.curves.size() == 1);
  CHECK(half.curves[0].title == "first");
  CHECK(half.curves[0].points == std::vector<std::pair<double, double>>{{1e-3, 5}, {2e-3, 7}});
  CHECK(half.x_unit == "m");
  CHECK(half.y_unit == "N");
  CHECK(half.x_label == "gap");
  REQUIRE(half.notes.size() == 1);
  CHECK(half.notes[0] == "not run: two");
  CHECK_THROWS_WITH(curves_of(plan.plots[1], plan, runs), Catch::Contains("none of its cases has run"));

  runs[plan.cases[1].name] = run_named("b");
  const Plot steps = curves_of(plan.plots[1], plan, runs);
  CHECK(steps.curves.at(0).points == std::vector<std::pair<double, double>>{{0.1, 4}, {0.2, 6}});
  CHECK(steps.x_unit == "s");
  CHECK(curves_of(plan.plots[0], plan, runs).curves.at(1).title == "two, pull");
}

TEST_CASE("plots of a batch have bars of its table, with published values across them", "[batch][plot]") {
  const TemporaryFolder folder;
  const BatchPlan plan = plan_with(folder,
                                   "  - {name: bars, bars: newton_iterations, per: steps, published: [{base: two, value: 8.5}], source: Them}\n"
                                   "  - {name: of one, bars: steps, bases: [one]}\n"
                                   "  - {name: wrong, bars: step}\n");
  const CsvTexts table{{"case", "steps", "newton_iterations"}, {{plan.cases[0].name, "10", "40"}, {plan.cases[1].name, "20", "60"}}};
  const StackedBars bars = bars_of(plan.plots[0], plan, table);
  CHECK(bars.names == std::vector<std::string>{"one", "two"});
  CHECK(bars.heights == std::vector<std::vector<double>>{{4}, {3}});
  REQUIRE(bars.marks.size() == 1);
  CHECK(bars.marks[0].bar == 1);
  CHECK(bars.marks[0].height == 8.5);
  CHECK(bars.marks[0].title == "8.5, Them");
  CHECK(bars.y_label == "newton_iterations / steps");
  CHECK(bars_of(plan.plots[1], plan, table).heights == std::vector<std::vector<double>>{{10}});
  CHECK_THROWS_WITH(bars_of(plan.plots[2], plan, table), Catch::Contains("no column 'step'") && Catch::Contains("steps"));
}

TEST_CASE("plots of a batch are kept in its folder, and refused before anything runs if they cannot be", "[batch][plot]") {
  const TemporaryFolder folder;
  const BatchPlan plan = plan_with(folder, "  - {name: figure, title: T, x_label: X, x_range: [0, 1.5e-3], curves: [{base: one, x: gap, y: pull, title: first}]}\n"
                                           "  - {name: bars, bars: steps, per: dofs, bases: [two], published: [{base: two, value: 2}], source: Them}\n");
  BatchFolder results;
  results.root = folder.path();
  write_description(results, {plan, "batch.yaml", {}, "{}"}, states_of(results, plan));
  const BatchPlan read = read_description(results).plan;
  REQUIRE(read.plots.size() == 2);
  CHECK(read.plots[0].title == "T");
  CHECK(read.plots[0].x_label == "X");
  CHECK(read.plots[0].curves.at(0).title == "first");
  CHECK(curves_of(read.plots[0], plan, {{plan.cases[0].name, run_named("a")}}).curves.at(0).points == std::vector<std::pair<double, double>>{{1e-3, 5}});
  CHECK(read.plots[1].per == "dofs");
  CHECK(read.plots[1].published.at(0).value == 2);
  CHECK(read.plots[1].source == "Them");

  CHECK_THROWS_WITH(plan_with(folder, "  - {name: a, curves: [{base: on, y: gap}]}\n"), Catch::Contains("there is no base 'on'") && Catch::Contains("one"));
  CHECK_THROWS_WITH(plan_with(folder, "  - {name: a, x_range: [2, 1], curves: [{base: one, y: gap}]}\n"), Catch::Contains("the second above the first"));
  CHECK_THROWS_WITH(plan_with(folder, "  - {name: a}\n"), Catch::Contains("either curves or bars"));
  CHECK_THROWS_WITH(plan_with(folder, "  - {name: a, bars: steps, published: [{base: one, value: 1}]}\n"), Catch::Contains("source"));
  CHECK_THROWS_WITH(plan_with(folder, "  - {name: a, bars: steps}\n  - {name: a, bars: dofs}\n"), Catch::Contains("two plots are named 'a'"));
}
