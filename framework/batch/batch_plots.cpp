#include "framework/batch/batch_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/batch/batch_plan.hpp"
#include "framework/config/nearest.hpp"
#include "framework/plot/run_plots.hpp"
#include "geometry/errors.hpp"

namespace tack {

void BatchPlot::CurveOf::fields(Fields& f) {
  f.text("base", base, "base whose runs are drawn").required();
  f.text("x", x, "a probe, `time`, or another column of steps.csv");
  f.text("y", y, "a probe, `time`, or another column of steps.csv").required();
  f.text("title", title, "name in the picture; the case and `y` unless given").line();
}

void BatchPlot::Published::fields(Fields& f) {
  f.text("base", base, "base across whose bar it is drawn").required();
  f.number("value", value, units::none, "published value");
}

void BatchPlot::fields(Fields& f) {
  f.text("name", name, "name of the picture's file").required().line();
  f.text("title", title, "title above the picture").line();
  f.text("x_label", x_label, "label of the x axis of curves; the first one's `x` unless given").line();
  f.text("y_label", y_label, "label of the y axis; the first one's `y`, or `bars`, unless given").line();
  f.numbers("x_range", x_range, units::none, "smallest and largest x of curves, in SI; all unless given").line();
  f.list("curves", curves, "curves of runs in one picture");
  f.text("bars", bars, "instead of curves: a bar per case, of this column of results.csv");
  f.text("per", per, "divides the bars by this column: `newton_iterations` per `steps`");
  f.texts("bases", bases, "bases whose cases have a bar; all unless given");
  f.list("published", published, "published numbers, each a line across a bar");
  f.text("source", source, "source of the published numbers").line();
  f.check("name", [this]() -> std::string {
    if (curves.empty() == bars.empty()) return "give either curves or bars";
    if (!curves.empty() && !(per.empty() && bases.empty() && published.empty())) return "per, bases and published are for bars";
    if (!x_range.empty() && (curves.empty() || x_range.size() != 2 || !(x_range[0] < x_range[1]))) return "x_range is for curves, and needs two numbers, the second above the first";
    if (!published.empty() && source.empty()) return "name the source of what was published";
    return "";
  });
}

std::string unknown_base(const BatchPlot& plot, const std::vector<std::string>& names) {
  std::vector<std::string> wanted = plot.bases;
  for (const auto& c : plot.curves) wanted.push_back(c.base);
  for (const auto& p : plot.published) wanted.push_back(p.base);
  for (const std::string& w : wanted)
    if (std::find(names.begin(), names.end(), w) == names.end()) return fmt::format("plot '{}': there is no base '{}'{}", plot.name, w, suggestion(w, names, "bases"));
  return "";
}

namespace {

// Returns a column of a run's probes, or of its steps.
std::optional<std::vector<double>> numbers_of(const PlottedRun& run, const std::string& column, bool of_steps) {
  const CsvTable& table = of_steps ? run.steps : run.probes;
  const auto at = table.column(column);
  if (!at) return std::nullopt;
  std::vector<double> numbers;
  for (const auto& row : table.rows) numbers.push_back(row[*at]);
  return numbers;
}

Curve curve_of(const BatchPlot::CurveOf& what, const PlottedRun& run, const std::string& title) {
  for (const bool of_steps : {false, true}) {
    const auto x = numbers_of(run, what.x, of_steps), y = numbers_of(run, what.y, of_steps);
    if (!x || !y) continue;
    Curve curve{title, {}, {}};
    for (size_t i = 0; i < x->size(); ++i) curve.points.emplace_back((*x)[i], (*y)[i]);
    return curve;
  }
  std::vector<std::string> columns = run.probes.columns;
  columns.insert(columns.end(), run.steps.columns.begin(), run.steps.columns.end());
  const bool there = std::find(columns.begin(), columns.end(), what.x) != columns.end();
  const std::string& missing = there ? what.y : what.x;
  throw InputError(fmt::format("the run '{}' has no '{}' beside '{}' in probes.csv or steps.csv{}", run.name, missing, there ? what.x : what.y,
                               suggestion(missing, columns, "columns")));
}

std::string unit_of(const PlottedRun& run, const std::string& column) {
  if (column == "time") return "s";
  const auto found = run.units.find(column);
  return found == run.units.end() ? "" : found->second;
}

double cell(const CsvTexts& table, const std::vector<std::string>& row, const std::string& column) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), column);
  if (found == table.columns.end()) throw InputError(fmt::format("the table has no column '{}'{}", column, suggestion(column, table.columns, "columns")));
  return csv_number(row[static_cast<size_t>(found - table.columns.begin())]).value_or(std::nan(""));
}

// Returns the base of a case if the base has no other case, else the name of the case.
std::string bar_name(const BatchPlan& plan, const BatchCase& one) {
  const auto same = std::count_if(plan.cases.begin(), plan.cases.end(), [&](const BatchCase& c) { return c.base == one.base; });
  return same == 1 && !one.base.empty() ? one.base : one.name;
}

}  // namespace

Plot curves_of(const BatchPlot& what, const BatchPlan& plan, const std::map<std::string, PlottedRun>& runs) {
  Plot plot{.title = what.title.empty() ? what.name : what.title, .x_label = what.x_label, .y_label = what.y_label, .style = Plot::Style::lines, .curves = {}, .levels = {}, .notes = {}};
  std::vector<std::string> missing;
  for (const auto& curve : what.curves) {
    bool ran = false;
    for (const BatchCase& one : plan.cases) {
      const auto run = runs.find(one.name);
      if (one.base != curve.base || run == runs.end()) continue;
      const std::string by = bar_name(plan, one);
      const bool several = by != one.base;
      const std::string title = curve.title.empty() ? by + ", " + curve.y : several ? curve.title + ", " + one.name : curve.title;
      if (plot.curves.empty()) {
        plot.x_unit = unit_of(run->second, curve.x);
        plot.y_unit = unit_of(run->second, curve.y);
      }
      plot.curves.push_back(curve_of(curve, run->second, title));
      ran = true;
    }
    if (!ran && std::find(missing.begin(), missing.end(), curve.base) == missing.end()) missing.push_back(curve.base);
  }
  if (plot.x_label.empty()) plot.x_label = what.curves.front().x;
  if (plot.y_label.empty()) plot.y_label = what.curves.front().y;
  if (plot.curves.empty()) throw InputError(fmt::format("plot '{}': none of its cases has run", what.name));
  if (!missing.empty()) plot.notes.push_back(fmt::format("not run: {}", fmt::join(missing, "; ")));
  if (!what.x_range.empty()) return within(std::move(plot), what.x_range[0], what.x_range[1]);
  return plot;
}

StackedBars bars_of(const BatchPlot& what, const BatchPlan& plan, const CsvTexts& table) {
  StackedBars bars{.title = what.title.empty() ? what.name : what.title, .y_label = what.y_label, .names = {}, .segments = {}, .heights = {}, .top = {}};
  if (bars.y_label.empty()) bars.y_label = what.per.empty() ? what.bars : what.bars + " / " + what.per;
  bars.segments = {"here"};
  for (const BatchCase& one : plan.cases) {
    if (!what.bases.empty() && std::find(what.bases.begin(), what.bases.end(), one.base) == what.bases.end()) continue;
    const auto row = std::find_if(table.rows.begin(), table.rows.end(), [&](const auto& r) { return r.front() == one.name; });
    if (row == table.rows.end()) continue;
    const double number = cell(table, *row, what.bars) / (what.per.empty() ? 1 : cell(table, *row, what.per));
    if (!std::isfinite(number)) continue;
    bars.names.push_back(bar_name(plan, one));
    bars.heights.push_back({number});
    for (const auto& published : what.published)
      if (published.base == one.base) bars.marks.push_back({bars.names.size() - 1, published.value, fmt::format("{:g}, {}", published.value, what.source)});
  }
  if (bars.names.empty()) throw InputError(fmt::format("plot '{}': no case has a number '{}'", what.name, what.bars));
  const auto unit = plan.units.find(what.bars);
  if (what.per.empty() && unit != plan.units.end()) bars.y_unit = unit->second;
  return bars;
}

}  // namespace tack
