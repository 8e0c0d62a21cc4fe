#include "framework/calibrate/measured_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/nearest.hpp"
#include "framework/measured/follow.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// A column of probes.csv with the unit of its probe.
Unit unit_of(const char* key, const std::string& column, const Experiment& scene) {
  if (column == "time") return units::time;
  std::vector<std::string> names{"time"};
  for (const auto& probe : scene.probes)
    for (const std::string& name : probe->columns()) {
      if (name == column) return probe->unit();
      names.push_back(name);
    }
  throw InputError(fmt::format("{}: the experiment has no probe '{}'{}", key, column, suggestion(column, names, "probes")));
}

double largest(const std::vector<double>& numbers) {
  double most = 0;
  for (const double y : numbers) most = std::max(most, std::abs(y));
  return most;
}

double noise_of(const Value& noise, const Unit& unit, double peak) {
  if (!noise.is_scalar()) throw InputError(fmt::format("noise: expects a number or a percentage, got {}", noise.description()));
  const bool relative = noise.text.find('%') != std::string::npos;
  const double s = relative ? to_si(noise.text, units::none) * peak : to_si(noise.text, unit);
  if (!(s > 0)) throw InputError(fmt::format("noise: '{}' must be above zero", noise.text));
  if (s >= peak)
    throw InputError(fmt::format("noise: '{}' is {:.4g}{}{}, and the largest measured value is {:.4g}: nothing would be left of the curve; a fraction of it is written with %, as 2%",
                                 noise.text, s, unit.plain() ? "" : " ", unit.plain() ? "" : unit.si, peak));
  return s;
}

MeasuredPoints points_of(const MeasuredExperiment& e, const Experiment& scene) {
  const Unit x = unit_of("x", e.x, scene), y = unit_of("y", e.y, scene);
  if (e.from) e.from->check(x);
  if (e.to) e.to->check(x);
  MeasuredPoints points{e.name, e.x, e.y, std::string(x.si), std::string(y.si), {}, !e.noise.is_null(), 1, e.weight};
  points.curve = MeasuredData{e.data, e.x_column, e.y_column, e.from, e.to, {}}.read(e.x, x, e.y, y);
  const double peak = largest(points.curve.y);
  if (peak == 0) throw InputError(fmt::format("{}: all measured values are 0; nothing can be compared with them", e.data));
  points.scale = points.noise_known ? noise_of(e.noise, y, peak) : peak;
  if (e.x == "time")
    for (size_t i = 0; i < points.curve.size(); ++i)
      if (points.curve.x[i] < 0 || points.curve.x[i] > scene.time.duration * (1 + 1e-9))
        throw InputError(fmt::format("{}: was measured at {:.6g} s, and the run goes from 0 to {:.6g} s: let it last longer (time.duration), or leave the point "
                                     "out (from, to)", points.curve.location(i), points.curve.x[i], scene.time.duration));
  return points;
}

std::vector<double> column_of(const ProbeSeries& run, const std::string& wanted) {
  const auto at = run.column(wanted);
  if (!at) throw InputError(fmt::format("probes.csv has no column '{}'", wanted));
  std::vector<double> numbers;
  for (const auto& row : run.rows) numbers.push_back(row[*at]);
  return numbers;
}

// Returns, for each point, where the run passes it and true, or else the sample with the nearest x
// and false.
std::vector<std::pair<Passage, bool>> counted_passages(const std::vector<double>& points, const std::vector<double>& xs) {
  std::vector<std::pair<Passage, bool>> all;
  for (const std::optional<Passage>& passage : passages(points, xs)) {
    const double point = points[all.size()];
    const auto nearer = [&](double a, double b) { return std::abs(a - point) < std::abs(b - point); };
    if (passage) all.emplace_back(*passage, true);
    else all.emplace_back(Passage{static_cast<size_t>(std::min_element(xs.begin(), xs.end(), nearer) - xs.begin()), 0}, false);
  }
  return all;
}

}  // namespace

std::vector<double> MeasuredPoints::simulated(const ProbeSeries& run, int& beyond) const {
  const std::vector<double> xs = column_of(run, x), ys = column_of(run, y);
  const auto finite = [](double number) { return std::isfinite(number); };
  if (xs.empty() || !std::all_of(xs.begin(), xs.end(), finite) || !std::all_of(ys.begin(), ys.end(), finite))
    throw InputError(fmt::format("the run has {} of {} over {}", xs.empty() ? "no samples" : "samples that are not finite", y, x));
  std::vector<double> found;
  beyond = 0;
  for (const auto& [passage, passed] : counted_passages(curve.x, xs)) {
    found.push_back(passage.value_of(ys));
    beyond += passed ? 0 : 1;
  }
  if (beyond == static_cast<int>(found.size()))
    throw InputError(fmt::format("the run reaches none of the measured points: its {} goes from {:.4g} to {:.4g}, that of {} from {:.4g} to {:.4g}", x,
                                 *std::min_element(xs.begin(), xs.end()), *std::max_element(xs.begin(), xs.end()), curve.path,
                                 *std::min_element(curve.x.begin(), curve.x.end()), *std::max_element(curve.x.begin(), curve.x.end())));
  return found;
}

std::vector<double> MeasuredPoints::derivatives(const ProbeSeries& run, const std::vector<double>& dx, const std::vector<double>& dy) const {
  const std::vector<double> xs = column_of(run, x), ys = column_of(run, y);
  std::vector<double> found;
  for (const auto& [at, passed] : counted_passages(curve.x, xs)) {
    double change = at.value_of(dy);
    if (passed && at.sample + 1 < xs.size() && xs[at.sample + 1] != xs[at.sample])
      change -= (ys[at.sample + 1] - ys[at.sample]) / (xs[at.sample + 1] - xs[at.sample]) * at.value_of(dx);
    found.push_back(std::sqrt(weight) * change / scale);
  }
  return found;
}

std::vector<double> MeasuredPoints::residuals(const std::vector<double>& simulated) const {
  std::vector<double> r(simulated.size());
  for (size_t i = 0; i < r.size(); ++i) r[i] = std::sqrt(weight) * (simulated[i] - curve.y[i]) / scale;
  return r;
}

MeasuredPoints measured_points(const MeasuredExperiment& experiment, const Experiment& scene) {
  try {
    return points_of(experiment, scene);
  } catch (const InputError& error) {
    throw InputError(fmt::format("experiment '{}': {}", experiment.name, error.what()));
  }
}

}  // namespace tack
