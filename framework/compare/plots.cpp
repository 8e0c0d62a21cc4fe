#include "framework/compare/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/compare/performance_profile.hpp"

namespace tack {
namespace {

// Below round-off of positions nothing is told apart any more.
constexpr double smallest_error = 1e-17;

Curve& curve_of(Plot& plot, const std::string& title) {
  for (Curve& c : plot.curves)
    if (c.title == title) return c;
  return plot.curves.emplace_back(Curve{title, {}});
}

std::set<std::string> problems_of(const std::vector<CompareRow>& rows) {
  std::set<std::string> problems;
  for (const CompareRow& r : rows) problems.insert(r.problem);
  return problems;
}

}  // namespace

Plot work_precision(const std::vector<CompareRow>& rows) {
  Plot plot{"time against error", "error / size of what moves (RMS over vertices, mean over problems)", "wall time [s]",
            true, true, false, {}};
  const size_t problems = problems_of(rows).size();
  std::set<double> steps;
  for (const CompareRow& r : rows) steps.insert(r.time_step);
  const bool by_step = problems == 1 && steps.size() > 1;
  struct Sum {
    double seconds = 0, log_error = 0;
    size_t count = 0;
  };
  std::vector<std::pair<std::string, std::vector<std::pair<double, Sum>>>> sums;  // title, tolerance
  std::set<std::pair<std::string, double>> incomplete;
  for (const CompareRow& r : rows) {
    const std::string title = by_step ? fmt::format("{}, h = {:g} s", r.solver, r.time_step) : r.solver;
    auto of_title = std::find_if(sums.begin(), sums.end(), [&](const auto& s) { return s.first == title; });
    if (of_title == sums.end()) of_title = sums.insert(sums.end(), {title, {}});
    auto& list = of_title->second;
    auto sum = std::find_if(list.begin(), list.end(), [&](const auto& s) { return s.first == r.tolerance; });
    if (sum == list.end()) sum = list.insert(list.end(), {r.tolerance, {}});
    const double relative = r.error_max > 0 ? r.error_rms * r.relative_error / r.error_max : 0.0;
    if (!r.solved() || !std::isfinite(r.error_rms)) incomplete.insert({title, r.tolerance});
    sum->second.seconds += r.wall_seconds;
    sum->second.log_error += std::log(std::max(relative, smallest_error));
    ++sum->second.count;
  }
  for (const auto& [title, list] : sums) {
    Curve& curve = curve_of(plot, title);
    for (const auto& [tolerance, sum] : list)
      if (!incomplete.count({title, tolerance}))
        curve.points.emplace_back(std::exp(sum.log_error / static_cast<double>(sum.count)), sum.seconds);
  }
  return plot;
}

Plot profile_plot(const std::vector<CompareRow>& rows) {
  Plot plot{"performance profile", "time / time of the fastest", "part of the tasks done", true, false, true, {}};
  const std::vector<Profile> profiles = performance_profiles(rows);
  double furthest = 1;
  for (const Profile& p : profiles)
    for (const double r : p.ratios)
      if (std::isfinite(r)) furthest = std::max(furthest, r);
  for (const Profile& p : profiles) {
    Curve& curve = curve_of(plot, p.solver);
    double done = 0;
    const double all = static_cast<double>(p.ratios.size());
    curve.points.emplace_back(1, 0);
    for (const double r : p.ratios)
      if (std::isfinite(r)) curve.points.emplace_back(r, ++done / all);
    curve.points.emplace_back(1.1 * furthest, done / all);
  }
  return plot;
}

Plot convergence_plot(const Comparison& comparison) {
  Plot plot{"convergence: the step of " + comparison.history_of + " with most iterations", "iteration",
            "residual [m/s]", false, true, false, {}};
  for (const IterationHistory& h : comparison.histories) {
    Curve& curve = curve_of(plot, h.solver);
    for (const Iteration& i : h.iterations) curve.points.emplace_back(i.number, i.residual * h.tolerance);
  }
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
