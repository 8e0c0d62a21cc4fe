#include "framework/output/statistic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "framework/config/nearest.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// The samples inside the window: times, abscissae and values, equally many.
struct Samples {
  std::vector<double> t, s, p;
  std::size_t size() const { return p.size(); }
};

std::size_t column_of(const ProbeSeries& series, const std::string& name) {
  if (const auto column = series.column(name)) return *column;
  throw InputError(
      fmt::format("unknown column '{}'{}", name, suggestion(name, series.columns, "columns")));
}

Samples samples_of(const StatisticQuery& query, const ProbeSeries& series) {
  const std::size_t time = column_of(series, "time");
  const std::size_t probe = column_of(series, query.probe);
  const std::size_t along = column_of(series, query.along);
  double t0 = -std::numeric_limits<double>::infinity();
  double t1 = -t0;
  if (query.over.size() == 2) {
    const double slack = 1e-9 * std::max(std::abs(query.over[0]), std::abs(query.over[1]));
    t0 = query.over[0] - slack;
    t1 = query.over[1] + slack;
  }
  Samples samples;
  for (const std::vector<double>& row : series.rows) {
    if (row[time] < t0 || row[time] > t1) continue;
    samples.t.push_back(row[time]);
    samples.s.push_back(row[along]);
    samples.p.push_back(row[probe]);
  }
  return samples;
}

// Why there is no statistic of these samples; "" if there is one.
std::string problem_with(const Samples& samples, const StatisticQuery& query) {
  if (samples.size() == 0) return "there are no samples";
  const bool along_matters =
      query.statistic == Statistic::integral || query.statistic == Statistic::at;
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
  return "";
}

double trapezoids(const std::vector<double>& s, const std::vector<double>& p) {
  double sum = 0;
  for (std::size_t i = 1; i < s.size(); ++i) sum += 0.5 * (p[i] + p[i - 1]) * (s[i] - s[i - 1]);
  return sum;
}

double mean(const Samples& samples) {
  const double duration = samples.t.back() - samples.t.front();
  if (duration > 0) return trapezoids(samples.t, samples.p) / duration;
  const double sum = std::accumulate(samples.p.begin(), samples.p.end(), 0.0);
  return sum / static_cast<double>(samples.size());
}

double peak(const std::vector<double>& p) {
  double largest = 0;
  for (const double value : p) largest = std::max(largest, std::abs(value));
  return largest;
}

std::optional<double> value_at(const Samples& samples, double where) {
  if (samples.s.front() == where) return samples.p.front();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double before = samples.s[i - 1] - where;
    const double after = samples.s[i] - where;
    if (after == 0) return samples.p[i];
    if ((before < 0) == (after < 0)) continue;
    const double part = before / (before - after);
    return (1 - part) * samples.p[i - 1] + part * samples.p[i];
  }
  return std::nullopt;
}

StatisticValue no_value(std::string problem) {
  return {std::numeric_limits<double>::quiet_NaN(), std::move(problem)};
}

StatisticValue at(const Samples& samples, const StatisticQuery& query) {
  if (const auto value = value_at(samples, query.where)) return {*value, ""};
  const auto [low, high] = std::minmax_element(samples.s.begin(), samples.s.end());
  return no_value(fmt::format("{} never reaches {}; it stays between {:.6g} and {:.6g}",
                              query.along, query.where, *low, *high));
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
      return {trapezoids(samples.s, samples.p), ""};
    case Statistic::at:
      return at(samples, query);
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
  }
  return "";
}

std::string unit_of(Statistic statistic, const Unit& probe, const Unit& along) {
  return statistic == Statistic::integral ? product_unit(probe, along) : std::string(probe.si);
}

StatisticValue evaluate(const StatisticQuery& query, const ProbeSeries& series) {
  const Samples samples = samples_of(query, series);
  if (std::string problem = problem_with(samples, query); !problem.empty()) {
    return no_value(std::move(problem));
  }
  StatisticValue result = compute(samples, query);
  if (result.problem.empty() && !std::isfinite(result.value)) {
    return no_value(fmt::format("the {} is not finite", to_string(query.statistic)));
  }
  return result;
}

std::string description(const StatisticQuery& query) {
  std::string text = fmt::format("{}: {}", query.probe, to_string(query.statistic));
  if (query.statistic == Statistic::integral && query.along != "time") {
    text += " along " + query.along;
  }
  if (query.statistic == Statistic::at) text += fmt::format(" {} = {}", query.along, query.where);
  if (query.over.size() == 2) {
    text += fmt::format(" from {} s to {} s", query.over[0], query.over[1]);
  }
  return text;
}

}  // namespace tack
