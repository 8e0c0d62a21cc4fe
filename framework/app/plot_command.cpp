// tack plot: pictures of runs, of a batch or of a comparison, for papers.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/app/commands.hpp"
#include "framework/batch/batch_description.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/measured/measured_curve.hpp"
#include "framework/output/file_names.hpp"
#include "framework/plot/gnuplot.hpp"
#include "framework/plot/run_plots.hpp"
#include "framework/plot/table_plots.hpp"
#include "framework/report/scene_data.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr size_t runs_max = 28;  // number of distinguishable curves

// Reads a run, with the units of its probes if its scene states them.
PlottedRun run_of(const fs::path& folder, const std::string& name) {
  PlottedRun run = plotted_run(folder, name);
  try {
    run.units = probe_units(folder / "scene.yaml");
  } catch (const InputError&) {
  }
  return run;
}

// Reads the points of a file, in SI.
Curve points_of(const std::string& file, const PlotOptions& options) {
  const MeasuredCurve curve = read_curve(file, {options.x, units::any, "--x"}, {options.y, units::any, "--y"});
  Curve points{fs::path(file).stem().string(), {}, {}, true};
  for (size_t i = 0; i < curve.size(); ++i) points.points.emplace_back(curve.x[i], curve.y[i]);
  return points;
}

Plot chosen(Plot plot, const PlotOptions& options) {
  if (!options.data.empty())
    for (Curve& curve : plot.curves)
      if (curve.title.empty()) curve.title = options.y;
  for (const std::string& file : options.data) plot.curves.push_back(points_of(file, options));
  plot.log_x = options.log_x;
  plot.log_y = options.log_y;
  return options.x_range.empty() ? plot : within(std::move(plot), options.x_range[0], options.x_range[1]);
}

class Pictures {
 public:
  explicit Pictures(fs::path folder, FigureStyle style = {}) : folder_(std::move(folder)), look_(std::move(style)) {
    std::error_code failed;
    fs::create_directories(folder_, failed);
    if (failed) throw InputError(fmt::format("{}: cannot be made ({}); choose another folder with -o", folder_.string(), failed.message()));
  }

  // Leaves out later pictures of this name.
  void keep(const std::string& name) { kept_.insert(name); }
  template <class Picture>
  void draw(const Picture& picture, const std::string& name) {
    if (!kept_.contains(name)) report(tack::draw(picture, folder_, name, look_), name);
  }
  void report(const std::string& failure, const std::string& name) {
    if (failure.empty()) fmt::print("{}\n", (folder_ / (name + ".svg")).string());
    else fmt::print("{}\n", failure);
    failed_ = failed_ || !failure.empty();
  }
  void draw_runs(const std::vector<PlottedRun>& runs) {
    if (runs.size() <= runs_max)
      for (const auto& [name, plot] : run_curves(runs)) draw(plot, name);
    if (const auto bars = phase_bars(runs)) {
      draw(*bars, "phases");
      draw(percentages_of(*bars), "phase_shares");
    }
  }
  int exit_code() const { return failed_ ? exit_expectation_failed : exit_done; }

 private:
  fs::path folder_;
  FigureStyle look_;
  std::set<std::string> kept_;
  bool failed_ = false;
};

// Returns the result columns: statistics and values of expectations.
std::vector<std::string> results_in(const CsvTexts& table) {
  std::vector<std::string> found;
  bool behind = false;
  for (const std::string& c : table.columns) {
    if (c == "steps") break;
    if (behind && !c.starts_with("expect:")) found.push_back(c);
    behind = behind || c == "error";
  }
  for (const char* cost : {"newton_iterations", "wall_seconds"}) found.push_back(cost);
  return found;
}

FigureStyle look_of(const PlotOptions& options) {
  const Value root = with_overrides(options.style.empty() ? Value::map() : parse_file(options.style), options.overrides);
  FigureStyle style;
  bind(root, style, "the style");
  return style;
}

int plot_batch(const PlotOptions& options, const BatchFolder& folder, const fs::path& output) {
  const BatchDescription batch = read_description(folder);
  const CsvTexts table = read_csv_texts(folder.table());
  Pictures pictures(output, look_of(options));
  if (!options.x.empty()) {
    TablePlot what{options.x, options.y, options.by, options.log_x, options.log_y};
    if (what.by.empty())
      for (const std::string& key : batch.plan.columns)
        if (key != what.x && key != "repeat") what.by.push_back(key);
    pictures.draw(chosen(table_plot(table, what, batch.plan.units), options), file_name(options.y) + "_by_" + file_name(options.x));
    return pictures.exit_code();
  }
  std::vector<PlottedRun> runs;
  std::map<std::string, PlottedRun> by_case;
  for (const BatchCase& one : batch.plan.cases)
    if (fs::exists(folder.run(one.name) / "steps.csv")) {
      runs.push_back(run_of(folder.run(one.name), batch.plan.columns.size() == 1 ? one.values.begin()->second : one.name));
      by_case[one.name] = runs.back();
    }
  FileNames names;
  for (const BatchPlot& what : batch.plan.plots) try {
      if (what.bars.empty()) pictures.draw(curves_of(what, batch.plan, by_case), names.of(what.name));
      else pictures.draw(bars_of(what, batch.plan, table), names.of(what.name));
      pictures.keep(names.of(what.name));
    } catch (const InputError& error) {
      pictures.report(error.what(), what.name);
    }
  for (const auto& [name, what] : default_table_plots(table, batch.plan.columns, results_in(table))) pictures.draw(table_plot(table, what, batch.plan.units), name);
  pictures.draw_runs(runs);
  return pictures.exit_code();
}

// Draws the pictures of a comparison or a calibration again, from the scripts in its folder `plots`. output: empty: there.
int plot_again(const fs::path& folder, const fs::path& output) {
  const fs::path scripts = folder / "plots";
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(scripts, missing))
    if (entry.path().extension() == ".gp") names.push_back(entry.path().stem());
  if (names.empty()) throw InputError(fmt::format("{}: has no scripts of pictures (.gp); the command that made {} writes them", scripts.string(), folder.string()));
  std::sort(names.begin(), names.end());
  const fs::path drawn = output.empty() ? scripts : output;
  Pictures pictures(drawn);
  for (const std::string& name : names) {
    const fs::path script = name + ".gp";
    if (!fs::equivalent(scripts, drawn)) fs::copy_file(scripts / script, drawn / script, fs::copy_options::overwrite_existing);
    pictures.report(draw_script(drawn, name), name);
  }
  return pictures.exit_code();
}

}  // namespace

int plot_command(const PlotOptions& options) {
  if (options.x_range.size() == 2 && !(options.x_range[0] < options.x_range[1]))
    throw InputError(fmt::format("--x-range: expects the smallest x and then the largest, got {:g} {:g}", options.x_range[0], options.x_range[1]));
  const fs::path first = options.folders.front();
  const bool calibration = fs::exists(first / "calibration.json"), batch = !calibration && fs::exists(first / "batch.json"),
             comparison = !calibration && !batch && fs::exists(first / "compare.csv");
  if (calibration && (options.folders.size() > 1 || !options.x.empty()))
    throw InputError(fmt::format("{}: is a calibration; draw it by itself, and columns of its points by its folder evaluations", first.string()));
  if ((batch || comparison) && options.folders.size() > 1)
    throw InputError(fmt::format("{}: is a {}; draw it by itself", first.string(), batch ? "batch" : "comparison"));
  if ((comparison || calibration) && (!options.style.empty() || !options.overrides.empty()))
    throw InputError(fmt::format("{}: pictures of a {} are drawn as they were made; change the scripts in its folder plots", first.string(), calibration ? "calibration" : "comparison"));
  if (comparison && !options.x.empty()) throw InputError(fmt::format("{}: --x and --y are for runs and batches", first.string()));
  if (!batch && !options.by.empty()) throw InputError(fmt::format("{}: --by is for the table of a batch", first.string()));
  if (comparison || calibration) return plot_again(first, options.output);
  fs::path output = options.output;
  if (output.empty()) output = options.folders.size() == 1 ? first / "plots" : fs::path("plots");
  if (batch) return plot_batch(options, BatchFolder::found(first), output);
  std::vector<PlottedRun> runs;
  for (const std::string& folder : options.folders) {
    const fs::path path = fs::weakly_canonical(folder);
    runs.push_back(run_of(folder, path.has_filename() ? path.filename() : path.parent_path().filename()));
  }
  Pictures pictures(output, look_of(options));
  if (options.x.empty()) pictures.draw_runs(runs);
  else pictures.draw(chosen(probe_curves(runs, options.x, options.y), options), file_name(options.y) + "_over_" + file_name(options.x));
  return pictures.exit_code();
}

}  // namespace tack
