#include "framework/plot/run_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/config/nearest.hpp"
#include "framework/output/file_names.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Returns a column over another; nothing if the table lacks one.
std::optional<Curve> over(const CsvTable& table, const std::string& x, const std::string& y, const std::string& title) {
  const auto along = table.column(x), at = table.column(y);
  if (!along || !at) return std::nullopt;
  Curve curve{title, {}, {}};
  for (const auto& row : table.rows) curve.points.emplace_back(row[*along], row[*at]);
  return curve;
}

// Returns the stages of the first protocol of a run.
std::vector<StageVisit> stages_of(const PlottedRun& run) {
  std::vector<StageVisit> stages;
  for (const StageVisit& v : run.stages)
    if (v.protocol == run.stages.front().protocol) stages.push_back(v);
  return stages;
}

// Returns a curve for each stage, in their order, broken where another stage comes between.
std::vector<Curve> by_stage(const PlottedRun& run, const std::string& x, const std::string& y) {
  const auto time = run.probes.column("time"), along = run.probes.column(x), at = run.probes.column(y);
  std::vector<Curve> curves;
  if (!time || !along || !at) return curves;
  for (const StageVisit& v : stages_of(run)) {
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const Curve& c) { return c.title == v.stage; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{v.stage, {}, {}});
    else curve->points.emplace_back(std::nan(""), 0);
    for (const auto& row : run.probes.rows)
      if (v.begin <= row[*time] && row[*time] <= v.end) curve->points.emplace_back(row[*along], row[*at]);
  }
  return curves;
}

std::optional<Curve> over_time(const CsvTable& table, const std::string& column, const std::string& title) {
  return over(table, "time", column, title);
}

// Returns the smallest gap between different objects; if none came close, the smallest distance
// including self-contact.
std::optional<Curve> smallest_gap(const PlottedRun& run) {
  auto gap = over_time(run.steps, "min_gap", run.name);
  const bool near = gap && std::any_of(gap->points.begin(), gap->points.end(), [](const auto& p) { return std::isfinite(p.second); });
  return near ? gap : over_time(run.steps, "min_distance", run.name);
}

struct StepColumn {
  const char* name;  // of the picture
  const char* column;
  const char* title;
  const char* y_label;
  const char* y_unit;
};

constexpr StepColumn step_columns[] = {{"iterations", "newton_iterations", "Newton iterations per step", "iterations", ""},
                                       {"step_seconds", "wall_seconds", "wall time per step", "time", "s"},
                                       {"contacts", "contacts", "contacts", "pairs of primitives", ""}};

std::string unit_of(const PlottedRun& run, const std::string& column) {
  if (column == "time") return "s";
  const auto unit = run.units.find(column);
  return unit == run.units.end() ? "" : unit->second;
}

// Returns the measured data of the runs by probe and abscissa; data that several runs share occur
// once.
std::map<std::pair<std::string, std::string>, Curve> measured_curves(const std::vector<PlottedRun>& runs) {
  std::map<std::pair<std::string, std::string>, Curve> curves;
  for (const PlottedRun& run : runs)
    for (const auto& row : run.measured.rows) {
      if (row.size() < 4) continue;
      const auto x = csv_number(row[2]), y = csv_number(row[3]);
      if (!x || !y) continue;
      Curve& curve = curves.try_emplace({row[0], row[1]}, Curve{"measured", {}, {}, true}).first->second;
      if (const std::pair point(*x, *y); std::find(curve.points.begin(), curve.points.end(), point) == curve.points.end()) curve.points.push_back(point);
    }
  return curves;
}

// Plots traction over gap of each pair.
std::optional<Plot> law_curves(const CsvTexts& laws) {
  Plot plot{.title = "laws of adhesion", .x_label = "gap", .y_label = "traction", .x_unit = "m", .y_unit = "Pa", .style = Plot::Style::lines, .curves = {}, .levels = {}, .notes = {}};
  const auto at = [&](const char* name) {
    return static_cast<size_t>(std::find(laws.columns.begin(), laws.columns.end(), name) - laws.columns.begin());
  };
  const size_t pair = at("pair"), gap = at("gap"), traction = at("traction");
  if (std::max({pair, gap, traction}) >= laws.columns.size()) return std::nullopt;
  for (const auto& row : laws.rows) {
    const auto x = csv_number(row[gap]), y = csv_number(row[traction]);
    if (!x || !y) continue;
    if (plot.curves.empty() || plot.curves.back().title != row[pair]) plot.curves.push_back({row[pair], {}, {}});
    plot.curves.back().points.emplace_back(*x, *y);
  }
  // Barrier tractions have no bound: the range shows the adhesive tractions.
  double peak = 0;
  for (const Curve& c : plot.curves)
    for (const auto& [x, y] : c.points) peak = std::max(peak, y);
  for (Curve& c : plot.curves) std::erase_if(c.points, [&](const auto& point) { return point.second < -peak; });
  std::erase_if(plot.curves, [](const Curve& c) { return c.points.empty(); });
  if (plot.curves.empty()) return std::nullopt;
  return plot;
}

}  // namespace

PlottedRun plotted_run(const fs::path& folder, const std::string& name) {
  if (!fs::exists(folder / "steps.csv"))
    throw InputError(fmt::format("{}: has no results of a run (no steps.csv); give a folder of `tack run`, `tack batch` or "
                                 "`tack compare`", folder.string()));
  PlottedRun run{name, read_csv(folder / "steps.csv"), {}, {}, {}, {}, {}};
  if (fs::exists(folder / "probes.csv")) run.probes = read_csv(folder / "probes.csv");
  if (fs::exists(folder / "laws.csv")) run.laws = read_csv_texts(folder / "laws.csv");
  run.stages = read_stages(folder / "stages.csv");
  if (fs::exists(folder / "measured.csv")) run.measured = read_csv_texts(folder / "measured.csv");
  return run;
}

std::map<std::string, Plot> run_curves(const std::vector<PlottedRun>& runs) {
  std::map<std::string, Plot> plots;
  FileNames names;
  const auto add = [&](const std::string& name, const char* title, const std::string& y_label, const std::string& y_unit, bool log, std::optional<Curve> curve) {
    if (!curve || curve->points.empty()) return;
    Plot& plot = plots[name];
    plot.title = title;
    plot.x_label = "time";
    plot.x_unit = "s";
    plot.y_label = y_label;
    plot.y_unit = y_unit;
    plot.log_y = log;
    plot.style = Plot::Style::lines;
    plot.curves.push_back(std::move(*curve));
    if (runs.size() == 1 && plot.bands.empty())
      for (const StageVisit& v : stages_of(runs.front())) plot.bands.push_back({v.begin, v.end, v.stage});
  };
  for (const PlottedRun& run : runs) {
    for (const std::string& column : run.probes.columns)
      if (column != "time") add("probe_" + names.of(column), column.c_str(), column, unit_of(run, column), false, over_time(run.probes, column, run.name));
    for (const StepColumn& s : step_columns) add(s.name, s.title, s.y_label, s.y_unit, false, over_time(run.steps, s.column, run.name));
    add("smallest_gap", "smallest gap", "gap", "m", true, smallest_gap(run));
    if (runs.size() > 1) continue;
    for (const std::string& column : run.steps.columns)
      if (column.starts_with("energy_")) add("energies", "energies", "energy", "J", false, over_time(run.steps, column, column.substr(7)));
    if (auto laws = law_curves(run.laws)) plots.emplace("laws", std::move(*laws));
  }
  const auto measured = measured_curves(runs);
  for (const auto& [of, data] : measured) {
    const auto &probe = of.first, &along = of.second;
    const bool several = std::count_if(measured.begin(), measured.end(), [&](const auto& other) { return other.first.first == probe; }) > 1;
    const auto drawn = [&](const PlottedRun& run) { return run.probes.column(probe) && run.probes.column(along); };
    if (std::any_of(runs.begin(), runs.end(), drawn)) plots.emplace("measured_" + names.of(several ? probe + "_over_" + along : probe), probe_curves(runs, along, probe));
  }
  return plots;
}

Plot probe_curves(const std::vector<PlottedRun>& runs, const std::string& x, const std::string& y) {
  Plot plot{.title = y + " over " + x, .x_label = x, .y_label = y, .x_unit = unit_of(runs.front(), x), .y_unit = unit_of(runs.front(), y), .style = Plot::Style::lines, .curves = {}, .levels = {}, .notes = {}};
  std::vector<std::string> without;
  if (runs.size() == 1 && x == "time")
    for (const StageVisit& v : stages_of(runs.front())) plot.bands.push_back({v.begin, v.end, v.stage});
  for (const PlottedRun& run : runs) {
    if (runs.size() == 1 && x != "time" && !run.stages.empty()) {
      plot.curves = by_stage(run, x, y);
      if (!plot.curves.empty()) break;
    }
    auto curve = over(run.probes, x, y, run.name);
    if (curve && !curve->points.empty()) plot.curves.push_back(std::move(*curve));
    else without.push_back(run.name);
  }
  if (plot.curves.empty()) {
    const std::vector<std::string>& columns = runs.front().probes.columns;
    const std::string& missing = runs.front().probes.column(x) ? y : x;
    throw InputError(fmt::format("no run has a probe '{}' with numbers{}", missing, suggestion(missing, columns, "probes")));
  }
  const auto data = measured_curves(runs);
  if (const auto found = data.find({y, x}); found != data.end()) plot.curves.push_back(found->second);
  if (!without.empty()) plot.notes.push_back(fmt::format("without these probes: {}", fmt::join(without, "; ")));
  return plot;
}

std::optional<StackedBars> phase_bars(const std::vector<PlottedRun>& runs) {
  StackedBars bars{"wall time per step, by phase", "time", {}, {}, {}, {}, "s"};
  const auto is_phase = [](const std::string& c) { return c.starts_with("seconds_"); };
  const auto takes_time = [](const CsvTable& steps, const std::string& column) {
    const size_t at = *steps.column(column);
    return std::any_of(steps.rows.begin(), steps.rows.end(), [&](const auto& row) { return row[at] > 0; });
  };
  for (const PlottedRun& run : runs)
    for (const std::string& column : run.steps.columns)
      if (is_phase(column) && takes_time(run.steps, column) && std::find(bars.segments.begin(), bars.segments.end(), column.substr(8)) == bars.segments.end())
        bars.segments.push_back(column.substr(8));
  for (const PlottedRun& run : runs) {
    if (run.steps.rows.empty()) continue;
    bars.names.push_back(run.name);
    std::vector<double>& heights = bars.heights.emplace_back();
    for (const std::string& segment : bars.segments) {
      double sum = 0;
      if (const auto at = run.steps.column("seconds_" + segment))
        for (const auto& row : run.steps.rows) sum += row[*at];
      heights.push_back(sum / static_cast<double>(run.steps.rows.size()));
    }
  }
  if (bars.names.empty() || bars.segments.empty()) return std::nullopt;
  return bars;
}

StackedBars percentages_of(StackedBars bars) {
  bars.title = "wall time by phase";
  bars.y_label = "fraction of the wall time [%]";
  bars.y_unit = "";
  bars.top = 100;
  for (std::vector<double>& segments : bars.heights) {
    const double sum = std::accumulate(segments.begin(), segments.end(), 0.0);
    for (double& p : segments) p *= sum > 0 ? 100 / sum : 0;
  }
  return bars;
}

}  // namespace tack
