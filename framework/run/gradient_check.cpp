#include "framework/run/gradient_check.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/config/nearest.hpp"
#include "framework/config/parse.hpp"
#include "framework/run/simulation.hpp"
#include "framework/sensitivity/gradients.hpp"
#include "framework/sensitivity/scene_parameter.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

struct Curve {
  std::vector<double> times, values, gradients;
  double seconds = 0;  // steps only, without reading and building
};

size_t column_of(const ProbeSet& probes, const std::string& column) {
  const auto& all = probes.columns();
  const auto found = std::find(all.begin(), all.end(), column);
  if (found == all.end()) throw InputError(fmt::format("--gradient: no column of probes.csv is named '{}'{}", column, suggestion(column, all, "columns")));
  return static_cast<size_t>(found - all.begin());
}

Curve curve_of(LoadedExperiment loaded, const std::string& column, std::vector<Warning>* warnings = nullptr) {
  Simulation simulation(std::move(loaded));
  ProbeSet probes = probes_of(simulation.built());
  const size_t at = column_of(probes, column);
  Gradients gradients(simulation.built());
  if (!gradients.empty()) simulation.observe_solved([&](const SolvedStep& step) { gradients.follow_solve(step); });
  Curve curve;
  const auto sample = [&] {
    const std::vector<double> values = probes.sample(simulation.world(), simulation.state());
    curve.times.push_back(simulation.state().time);
    curve.values.push_back(values[at]);
    if (!gradients.empty()) curve.gradients.push_back(gradients.values(values)[at]);
  };
  const double began = user_seconds();
  simulation.start();
  simulation.world().participants.move_to(simulation.state().x);
  if (!gradients.empty()) gradients.start();
  sample();
  while (!simulation.finished()) {
    simulation.step();
    if (simulation.interrupted()) throw SimulationError("interrupted");
    if (!gradients.empty()) gradients.accept(simulation.state());
    sample();
  }
  curve.seconds = user_seconds() - began;
  if (warnings) *warnings = gradients.warnings();
  return curve;
}

// Returns the index of the sample at a time; the size if there is none. Times ascend.
size_t place(const Curve& curve, double time, double tolerance) {
  const auto found = std::lower_bound(curve.times.begin(), curve.times.end(), time - tolerance);
  if (found == curve.times.end() || *found > time + tolerance) return curve.times.size();
  return static_cast<size_t>(found - curve.times.begin());
}

LoadedExperiment with_gradient(const BuiltExperiment& built, const std::string& key) {
  Value root = built.root(), list = Value::sequence(), entry = Value::map();
  entry.set("key", Value::scalar(key));
  list.items.push_back(std::move(entry));
  set_at(root, "output.gradients", std::move(list));
  return bound_experiment(std::move(root));
}

void compare(const Curve& run, const Curve& less, const Curve& more, double tolerance, GradientCheck& check) {
  for (size_t i = 0; i < run.times.size(); ++i) {
    const size_t a = place(less, run.times[i], tolerance), b = place(more, run.times[i], tolerance);
    if (a == less.times.size() || b == more.times.size()) continue;
    const double difference = (more.values[b] - less.values[a]) / (2 * check.step);
    if (!std::isfinite(difference) || !std::isfinite(run.gradients[i])) continue;
    check.times.push_back(run.times[i]);
    check.gradients.push_back(run.gradients[i]);
    check.differences.push_back(difference);
    check.largest = std::max(check.largest, std::abs(difference));
    check.largest_gradient = std::max(check.largest_gradient, std::abs(run.gradients[i]));
    check.largest_value = std::max({check.largest_value, std::abs(less.values[a]), std::abs(more.values[b])});
  }
  std::vector<double> errors;
  for (size_t i = 0; i < check.times.size(); ++i) errors.push_back(check.error(i));
  if (errors.empty()) return;
  check.worst = static_cast<size_t>(std::max_element(errors.begin(), errors.end()) - errors.begin());
  std::sort(errors.begin(), errors.end());
  check.median_error = errors[errors.size() / 2];
}

}  // namespace

bool GradientCheck::nothing_to_compare() const {
  constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();  // of a difference of two values
  return largest * 2 * step <= round_off * largest_value;
}

GradientCheck check_gradient(const LoadedExperiment& loaded, const std::string& column, const std::string& key, double relative_step) {
  const BuiltExperiment built(bound_experiment(loaded.root));
  GradientCheck check{};
  check.number = scene_parameter(built, key);
  check.step = check.number != 0 ? std::abs(check.number) * relative_step : relative_step;
  const Curve run = curve_of(with_gradient(built, key), column, &check.warnings);
  const Curve less = curve_of(scene_with(built, key, check.number - check.step), column);
  const Curve more = curve_of(scene_with(built, key, check.number + check.step), column);
  check.cost = 2 * run.seconds / std::max(less.seconds + more.seconds, 1e-9);
  compare(run, less, more, 1e-6 * built.experiment().time.step, check);
  return check;
}

}  // namespace tack
