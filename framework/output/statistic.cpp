#include "framework/output/statistic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <optional>

#include "framework/config/nearest.hpp"
#include "framework/measured/follow.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Samples that count: times, abscissae and values, of equal length.
struct Samples {
  std::vector<double> t, s, p;
  std::vector<std::size_t> starts;  // first sample of each window that has one
  std::size_t size() const { return p.size(); }
  // Returns the index behind the last sample of window k.
  std::size_t end_of(std::size_t k) const { return k + 1 < starts.size() ? starts[k + 1] : size(); }
};

std::size_t column_of(const ProbeSeries& series, const std::string& name) {
  if (const auto column = series.column(name)) return *column;
  throw InputError(
      fmt::format("unknown column '{}'{}", name, suggestion(name, series.columns, "columns")));
}

Samples samples_of(const StatisticQuery& query, const ProbeSeries& series, const TimeWindows& windows) {
  const std::size_t time = column_of(series, "time");
  const std::size_t probe = column_of(series, query.probe);
  const std::size_t along = column_of(series, query.along);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double t0 = -infinity;
  double t1 = infinity;
  if (query.over.size() == 2) {
    const double slack = 1e-9 * std::max(std::abs(query.over[0]), std::abs(query.over[1]));
    t0 = query.over[0] - slack;
    t1 = query.over[1] + slack;
  }
  Samples samples;
  for (const TimeWindow& window : windows.value_or(std::vector<TimeWindow>{{-infinity, infinity}})) {
    const std::size_t start = samples.size();
    for (const std::vector<double>& row : series.rows) {
      if (row[time] < std::max(t0, window.begin) || row[time] > std::min(t1, window.end)) continue;
      samples.t.push_back(row[time]);
      samples.s.push_back(row[along]);
      samples.p.push_back(row[probe]);
    }
    if (samples.size() > start) samples.starts.push_back(start);
  }
  return samples;
}

// Returns why the samples have no such statistic; "" if they have.
std::string problem_with(const Samples& samples, const StatisticQuery& query) {
  if (samples.size() == 0) return "there are no samples";
  const bool along_matters = query.statistic == Statistic::integral || query.statistic == Statistic::at || is_deviation(query.statistic);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (std::isnan(samples.t[i])) return "a sample has no time";
    const bool bad_abscissa = along_matters && std::isnan(samples.s[i]);
    if (!bad_abscissa && !std::isnan(samples.p[i])) continue;
    return fmt::format("{} is not a number at t = {:.6g} s",
                       bad_abscissa ? query.along : query.probe, samples.t[i]);
  }
  if (query.statistic == Statistic::integral && samples.size() < 2) {
    return "an integral needs two samples, there is one";
  }
  if (query.statistic == Statistic::integral && samples.size() == samples.starts.size()) {
    return fmt::format("an integral needs two samples, there is one in each of {} times", samples.starts.size());
  }
  return "";
}

// Returns int p ds over all windows. s: times or abscissae of the samples.
double trapezoids(const Samples& samples, const std::vector<double>& s) {
  const std::vector<double>& p = samples.p;
  double sum = 0;
  for (std::size_t k = 0; k < samples.starts.size(); ++k)
    for (std::size_t i = samples.starts[k] + 1; i < samples.end_of(k); ++i) sum += 0.5 * (p[i] + p[i - 1]) * (s[i] - s[i - 1]);
  return sum;
}

double mean(const Samples& samples) {
  double duration = 0;
  for (std::size_t k = 0; k < samples.starts.size(); ++k) duration += samples.t[samples.end_of(k) - 1] - samples.t[samples.starts[k]];
  if (duration > 0) return trapezoids(samples, samples.t) / duration;
  const double sum = std::accumulate(samples.p.begin(), samples.p.end(), 0.0);
  return sum / static_cast<double>(samples.size());
}

double peak(const std::vector<double>& p) {
  double largest = 0;
  for (const double value : p) largest = std::max(largest, std::abs(value));
  return largest;
}

std::optional<double> value_at(const Samples& samples, double where) {
  for (std::size_t k = 0; k < samples.starts.size(); ++k) {
    const std::size_t start = samples.starts[k];
    if (samples.s[start] == where) return samples.p[start];
    for (std::size_t i = start + 1; i < samples.end_of(k); ++i) {
      const double before = samples.s[i - 1] - where;
      const double after = samples.s[i] - where;
      if (after == 0) return samples.p[i];
      if ((before < 0) == (after < 0)) continue;
      const double fraction = before / (before - after);
      return (1 - fraction) * samples.p[i - 1] + fraction * samples.p[i];
    }
  }
  return std::nullopt;
}

StatisticValue no_value(std::string problem) {
  return {std::numeric_limits<double>::quiet_NaN(), std::move(problem)};
}

StatisticValue at(const Samples& samples, const StatisticQuery& query) {
  if (const auto value = value_at(samples, query.where)) return {*value, ""};
  const auto [low, high] = std::minmax_element(samples.s.begin(), samples.s.end());
  const bool between = *low < query.where && query.where < *high;  // windows
  return no_value(fmt::format("{} never reaches {}; it {} {:.6g} and {:.6g}", query.along, query.where,
                              between ? "only jumps over it from one time of the stage to the next, between" : "stays between", *low, *high));
}

std::string uncovered_points_text(const MeasuredComparison& f, const Samples& samples, const StatisticQuery& query) {
  const auto [low, high] = std::minmax_element(samples.s.begin(), samples.s.end());
  const auto missed = std::count_if(f.run.begin(), f.run.end(), [](double y) { return std::isnan(y); });
  const size_t first = static_cast<size_t>(std::find_if(f.run.begin(), f.run.end(), [](double y) { return std::isnan(y); }) - f.run.begin());
  const bool beyond = f.curve.x[first] < *low || f.curve.x[first] > *high;
  return fmt::format("the run does not pass {} of {} measured points, the first at {} ({} = {:.6g}): {} goes from {:.6g} to {:.6g}{}", missed, f.run.size(), f.curve.location(first),
                     query.along, f.curve.x[first], query.along, *low, *high,
                     beyond ? "; simulate more, or exclude them with from and to"
                     : samples.starts.size() > 1 ? ", over several times of the stage; each point must be passed within one of them"
                                                 : ", and reverses; the data must be in the order in which they were measured");
}

MeasuredComparison compare_samples(const StatisticQuery& query, const Samples& samples) {
  MeasuredCurve curve = query.follows->read(query.along, units::any, query.probe, units::any);
  std::vector<double> run = follow(curve.x, samples.s, samples.p, samples.starts);
  return {std::move(curve), std::move(run)};
}

StatisticValue deviation(const StatisticQuery& query, const Samples& samples) {
  const MeasuredComparison f = compare_samples(query, samples);
  if (std::any_of(f.run.begin(), f.run.end(), [](double y) { return std::isnan(y); })) return no_value(uncovered_points_text(f, samples, query));
  const Deviation d = deviation_of(f.curve, f.run, query.follows->scale);
  if (!std::isfinite(d.worst))
    return no_value(fmt::format("the measured {} at {} is 0, and so that a relative deviation is undefined; use `relative_to: peak`", query.probe, f.curve.location(d.worst_at)));
  const double value = query.statistic == Statistic::deviation ? d.mean : query.statistic == Statistic::rms_deviation ? d.rms : d.worst;
  return {value, "", fmt::format("{} points, on average {:+.2f}%, worst {:.2f}% at {} = {:.6g}", d.compared, 100 * d.bias, 100 * d.worst, query.along, f.curve.x[d.worst_at])};
}

StatisticValue compute(const Samples& samples, const StatisticQuery& query) {
  switch (query.statistic) {
    case Statistic::final:
      return {samples.p.back(), ""};
    case Statistic::mean:
      return {mean(samples), ""};
    case Statistic::max:
      return {*std::max_element(samples.p.begin(), samples.p.end()), ""};
    case Statistic::min:
      return {*std::min_element(samples.p.begin(), samples.p.end()), ""};
    case Statistic::peak:
      return {peak(samples.p), ""};
    case Statistic::integral:
      return {trapezoids(samples, samples.s), ""};
    case Statistic::at:
      return at(samples, query);
    case Statistic::deviation:
    case Statistic::rms_deviation:
    case Statistic::worst_deviation:
      return deviation(query, samples);
  }
  return no_value("unknown statistic");
}

}  // namespace

std::string_view to_string(Statistic statistic) {
  switch (statistic) {
    case Statistic::final:
      return "final";
    case Statistic::mean:
      return "mean";
    case Statistic::max:
      return "max";
    case Statistic::min:
      return "min";
    case Statistic::peak:
      return "peak";
    case Statistic::integral:
      return "integral";
    case Statistic::at:
      return "at";
    case Statistic::deviation:
      return "deviation";
    case Statistic::rms_deviation:
      return "rms_deviation";
    case Statistic::worst_deviation:
      return "worst_deviation";
  }
  return "";
}

bool is_deviation(Statistic statistic) {
  return statistic == Statistic::deviation || statistic == Statistic::rms_deviation || statistic == Statistic::worst_deviation;
}

std::string unit_of(Statistic statistic, const Unit& probe, const Unit& along) {
  if (is_deviation(statistic)) return std::string(units::none.si);
  return statistic == Statistic::integral ? product_unit(probe, along) : std::string(probe.si);
}

StatisticValue evaluate(const StatisticQuery& query, const ProbeSeries& series, const TimeWindows& windows) {
  const Samples samples = samples_of(query, series, windows);
  if (std::string problem = problem_with(samples, query); !problem.empty()) {
    return no_value(std::move(problem));
  }
  StatisticValue result{};
  try {
    result = compute(samples, query);
  } catch (const InputError& error) {  // a data file may have disappeared since the run began
    return no_value(error.what());
  }
  if (result.problem.empty() && !std::isfinite(result.value)) {
    return no_value(fmt::format("the {} is not finite", to_string(query.statistic)));
  }
  return result;
}

MeasuredComparison compare_with_measured(const StatisticQuery& query, const ProbeSeries& series, const TimeWindows& windows) {
  return compare_samples(query, samples_of(query, series, windows));
}

std::string description(const StatisticQuery& query) {
  std::string text = fmt::format("{}: {}", query.probe, to_string(query.statistic));
  if (query.statistic == Statistic::integral && query.along != "time") {
    text += " along " + query.along;
  }
  if (query.follows) text += fmt::format(" from {} along {}", std::filesystem::path(query.follows->file).filename().string(), query.along);
  if (query.statistic == Statistic::at) text += fmt::format(" {} = {}", query.along, query.where);
  if (query.over.size() == 2) {
    text += fmt::format(" from {} s to {} s", query.over[0], query.over[1]);
  }
  return text;
}

}  // namespace tack
