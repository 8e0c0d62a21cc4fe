#include "framework/compare/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "framework/compare/performance_profile.hpp"
#include "framework/plot/gnuplot.hpp"

namespace tack {
namespace {

// Smaller errors are below the round-off of positions.
constexpr double smallest_error = 1e-17;
constexpr double far_from_points = 1e3;  // a line further away would squeeze the points

Curve& curve_of(Plot& plot, const std::string& title) {
  for (Curve& c : plot.curves)
    if (c.title == title) return c;
  return plot.curves.emplace_back(Curve{title, {}, {}});
}

// Appends a note with names, in several lines if needed.
void add_notes(Plot& plot, std::string line, const std::vector<std::string>& names) {
  constexpr size_t longest = 90;
  for (size_t i = 0; i < names.size(); ++i) {
    const std::string more = " " + names[i] + (i + 1 < names.size() ? "," : "");
    if (line.size() + more.size() > longest) plot.notes.push_back(std::exchange(line, "   "));
    line += more;
  }
  if (!names.empty()) plot.notes.push_back(line);
}

// Appends a note with the solvers that have results of too large an error, and the limit.
void add_inaccurate(Plot& plot, const std::vector<CompareRow>& rows) {
  std::map<double, std::vector<std::string>> names;  // by limit
  for (const CompareRow& r : rows) {
    if (!r.inaccurate()) continue;
    const std::string name = fmt::format("{} at {:g} m/s", r.solver, r.tolerance);
    std::vector<std::string>& of_limit = names[r.error_limit];
    if (std::find(of_limit.begin(), of_limit.end(), name) == of_limit.end()) of_limit.push_back(name);
  }
  for (const auto& [limit, of_limit] : names) add_notes(plot, fmt::format("failures by inaccuracy, relative error above {:g} (error_limit):", limit), of_limit);
}

std::set<std::string> problems_of(const std::vector<CompareRow>& rows) {
  std::set<std::string> problems;
  for (const CompareRow& r : rows) problems.insert(r.problem);
  return problems;
}

// Returns the problems that every solver solves at one tolerance at least, of solvers that solve
// anything; the sums of a curve are over these, so that a method that fails on one problem keeps
// its curve. All problems if there is no such problem.
std::set<std::string> commonly_solved(const std::vector<CompareRow>& rows) {
  std::map<std::string, std::set<std::string>> solved;  // by solver
  for (const CompareRow& r : rows)
    if (r.solved() && std::isfinite(r.error_rms)) solved[r.solver].insert(r.problem);
  const std::set<std::string> all = problems_of(rows);
  std::set<std::string> common = all;
  for (const auto& [solver, problems] : solved)
    std::erase_if(common, [&](const std::string& problem) { return !problems.count(problem); });
  return common.empty() ? all : common;
}

// Returns lines at the distance of the two references, averaged over the problems as errors are;
// one line per time step if `by_step`.
std::vector<LevelLine> floors(const std::vector<CompareRow>& rows, bool by_step) {
  std::map<double, std::map<std::string, double>> of_step;
  for (const CompareRow& r : rows)
    if (r.floor > 0 && r.size > 0) of_step[by_step ? r.time_step : 0][r.problem] = r.floor / r.size;
  std::map<double, std::string> lines;  // one line if all steps share a reference
  for (const auto& [step, of_problem] : of_step) {
    double sum = 0;
    for (const auto& [problem, floor] : of_problem) sum += std::log(floor);
    std::string& title = lines[std::exp(sum / static_cast<double>(of_problem.size()))];
    title += by_step ? fmt::format("{}{:g} s", title.empty() ? "floor, h = " : ", ", step) : "noise floor: errors to the left are noise";
  }
  std::vector<LevelLine> found;
  for (const auto& [at, title] : lines) found.push_back({at, title});
  return found;
}

}  // namespace

Plot work_precision(const std::vector<CompareRow>& all) {
  // An unsolved problem would leave every solver without points.
  std::set<std::string> unsolved_problems = problems_of(all);
  for (const CompareRow& r : all)
    if (r.solved()) unsolved_problems.erase(r.problem);
  std::vector<CompareRow> rows;
  std::copy_if(all.begin(), all.end(), std::back_inserter(rows), [&](const CompareRow& r) { return !unsolved_problems.count(r.problem); });
  Plot plot;
  add_notes(plot, "omitted, as no solver solves it:",
            {unsolved_problems.begin(), unsolved_problems.end()});
  const std::set<std::string> common = commonly_solved(rows);
  const size_t solvable = problems_of(rows).size();
  std::map<std::string, std::set<std::string>> failed_on;  // solvers, by problem that does not count
  for (const CompareRow& r : rows)
    if (!common.count(r.problem)) failed_on[r.problem];
  for (auto& [problem, solvers] : failed_on) {
    for (const CompareRow& r : rows)
      if (r.problem == problem) solvers.insert(r.solver);
    for (const CompareRow& r : rows)
      if (r.problem == problem && r.solved() && std::isfinite(r.error_rms)) solvers.erase(r.solver);
  }
  std::erase_if(rows, [&](const CompareRow& r) { return !common.count(r.problem); });
  if (common.size() < solvable) {
    plot.notes.push_back(
        fmt::format("{} of {} problems count: those that all methods with a curve solve",
                    common.size(), solvable));
    std::vector<std::string> names;
    for (const auto& [problem, solvers] : failed_on)
      names.push_back(fmt::format("{} ({})", problem, fmt::join(solvers, ", ")));
    add_notes(plot, "left out, with those that fail on it:", names);
  }
  plot.title = "time against error";
  plot.x_label = "relative error (RMS over vertices, mean over problems)";
  plot.y_label = "wall time";
  plot.y_unit = "s";
  plot.log_x = plot.log_y = true;
  const size_t problems = problems_of(rows).size();
  std::set<double> steps;
  for (const CompareRow& r : rows) steps.insert(r.time_step);
  const bool by_step = problems == 1 && steps.size() > 1;
  struct Sum {
    // least, most: of the sum of times, if they vary together.
    double seconds = 0, least = 0, most = 0, log_error = 0;
    size_t count = 0, below_floor = 0;
  };
  std::vector<std::pair<std::string, std::vector<std::pair<double, Sum>>>> sums;  // title, tolerance
  std::set<std::pair<std::string, double>> incomplete;
  std::map<std::string, std::set<std::string>> failed;  // by title: problems
  for (const CompareRow& r : rows) {
    const std::string title = by_step ? fmt::format("{}, h = {:g} s", r.solver, r.time_step) : r.solver;
    auto of_title = std::find_if(sums.begin(), sums.end(), [&](const auto& s) { return s.first == title; });
    if (of_title == sums.end()) of_title = sums.insert(sums.end(), {title, {}});
    auto& list = of_title->second;
    auto sum = std::find_if(list.begin(), list.end(), [&](const auto& s) { return s.first == r.tolerance; });
    if (sum == list.end()) sum = list.insert(list.end(), {r.tolerance, {}});
    if (!r.solved() || !std::isfinite(r.error_rms)) {
      incomplete.insert({title, r.tolerance});
      failed[title].insert(r.problem);
    }
    sum->second.seconds += r.wall_seconds;
    sum->second.least += r.wall_min;
    sum->second.most += r.wall_max;
    sum->second.log_error += std::log(std::max(r.known_error() / r.size, smallest_error));
    ++sum->second.count;
    sum->second.below_floor += r.below_floor() ? 1 : 0;
  }
  std::vector<std::string> unsolved, partly, below_floor;
  for (const auto& [title, list] : sums) {
    Curve& curve = curve_of(plot, title);
    for (const auto& [tolerance, sum] : list) {
      if (incomplete.count({title, tolerance})) continue;
      if (sum.below_floor == sum.count) {
        below_floor.push_back(fmt::format("{} at {:g} m/s", title, tolerance));
        continue;
      }
      curve.points.emplace_back(std::exp(sum.log_error / static_cast<double>(sum.count)), sum.seconds);
      curve.spread.emplace_back(sum.least, sum.most);
    }
    if (failed[title].empty()) continue;
    const size_t failures = failed[title].size();
    const std::string problem = problems == 1 ? "" : failures == 1 ? *failed[title].begin() : fmt::format("{} of {} problems", failures, problems);
    const std::string label = problem.empty() ? title : fmt::format("{} ({})", title, problem);
    (curve.points.empty() ? unsolved : partly).push_back(label);
  }
  add_notes(plot, std::string(problems > 1 ? "all problems " : "") + "solved at no tolerance:", unsolved);
  add_notes(plot, "failed at some tolerances:", partly);
  add_notes(plot, "no point, as the error is below the noise floor:", below_floor);
  add_inaccurate(plot, all);
  double least = std::numeric_limits<double>::infinity();
  for (const Curve& c : plot.curves)
    for (const auto& [error, seconds] : c.points) least = std::min(least, error);
  for (LevelLine& floor : floors(rows, by_step)) {
    if (floor.at > least / far_from_points) plot.verticals.push_back(std::move(floor));
    else plot.notes.push_back(fmt::format("the noise floor is {:.1g}, further left", floor.at));
  }
  return plot;
}

Plot profile_plot(const std::vector<CompareRow>& rows) {
  Plot plot;
  plot.title = "performance profile";
  plot.x_label = "time / time of the fastest";
  plot.y_label = "fraction of tasks solved";
  plot.log_x = true;
  plot.style = Plot::Style::steps;
  const std::vector<PerformanceProfile> profiles = performance_profiles(rows);
  std::vector<std::string> unsolved;
  double furthest = 1;
  for (const PerformanceProfile& p : profiles)
    for (const double r : p.ratios)
      if (std::isfinite(r)) furthest = std::max(furthest, r);
  for (const PerformanceProfile& p : profiles) {
    Curve& curve = curve_of(plot, p.solver);
    double done = 0;
    const double all = static_cast<double>(p.ratios.size());
    curve.points.emplace_back(1, 0);
    for (const double r : p.ratios)
      if (std::isfinite(r)) curve.points.emplace_back(r, ++done / all);
    curve.points.emplace_back(1.1 * furthest, done / all);
    if (done == 0) unsolved.push_back(p.solver);
  }
  add_notes(plot, "solved nothing:", unsolved);
  add_inaccurate(plot, rows);
  return plot;
}

Plot convergence_plot(const Comparison& comparison) {
  Plot plot;
  // Friction and prescribed motion make several minimisations of a step: they follow one another.
  plot.title = "convergence: all minimisations of the step of " + comparison.history_of +
               " with most iterations";
  plot.x_label = "iteration";
  plot.y_label = "residual";
  plot.y_unit = "m/s";
  plot.log_y = true;
  plot.style = Plot::Style::lines;
  size_t longest = 1, shortest = std::numeric_limits<size_t>::max();
  double tolerance = 0;
  for (const IterationHistory& h : comparison.histories) {
    Curve& curve = curve_of(plot, h.solver);
    // Methods that did not evaluate the residual repeat the last known one, which is no new point.
    for (const Iteration& i : h.iterations)
      if (&i == &h.iterations.back() || curve.points.empty() || curve.points.back().second != i.residual * h.tolerance)
        curve.points.emplace_back(i.number, i.residual * h.tolerance);
    if (!h.iterations.empty()) longest = std::max(longest, h.iterations.size()), shortest = std::min(shortest, h.iterations.size());
    tolerance = h.tolerance;
  }
  plot.log_x = longest > 5 * shortest;
  if (tolerance > 0) plot.levels.push_back({tolerance, fmt::format("tolerance {:g} m/s", tolerance)});
  return plot;
}

std::vector<std::string> draw_plots(const Comparison& comparison, const std::filesystem::path& folder) {
  const auto plots = folder / "plots";
  std::filesystem::create_directories(plots);
  std::vector<std::string> failures;
  for (const auto& [name, plot] : {std::pair<std::string, Plot>("work_precision", work_precision(comparison.rows)),
                                   {"performance_profile", profile_plot(comparison.rows)},
                                   {"convergence", convergence_plot(comparison)}})
    if (std::string failure = draw(plot, plots, name); !failure.empty()) failures.push_back(std::move(failure));
  return failures;
}

}  // namespace tack
