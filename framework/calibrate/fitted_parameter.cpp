#include "framework/calibrate/fitted_parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "framework/batch/results_table.hpp"
#include "framework/config/nearest.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

std::vector<std::string> key_list(const Value& value, const std::string& name) {
  const std::vector<Value> items = value.is_sequence() ? value.items : std::vector<Value>{value};
  std::vector<std::string> keys;
  for (const Value& item : items) {
    if (!item.is_scalar() || item.text.empty())
      throw InputError(fmt::format("{}: fit '{}': keys: expects a key, a list of keys, or a map of experiments to them, got {}", value.mark.text(), name,
                                   value.description()));
    keys.push_back(item.text);
  }
  return keys;
}

std::vector<std::vector<std::string>> keys_of(const std::string& name, const FitConfig& fit, const std::vector<MeasuredExperiment>& experiments) {
  std::vector<std::vector<std::string>> keys(experiments.size(), {name});
  if (fit.keys.is_null()) return keys;
  if (!fit.keys.is_map()) return {experiments.size(), key_list(fit.keys, name)};
  keys.assign(experiments.size(), {});
  std::vector<std::string> names;
  for (const MeasuredExperiment& e : experiments) names.push_back(e.name);
  for (const Value::Entry& entry : fit.keys.entries) {
    const auto at = std::find(names.begin(), names.end(), entry.key);
    if (at == names.end())
      throw InputError(fmt::format("{}: fit '{}': keys: there is no experiment '{}'{}", entry.mark.text(), name, entry.key,
                                   suggestion(entry.key, names, "experiments")));
    keys[static_cast<size_t>(at - names.begin())] = key_list(entry.value, name);
  }
  return keys;
}

std::string last_element(const std::string& key) { return key.substr(key.rfind('.') + 1); }

// Returns the default name: the last element of the key, or the whole key if another key has the
// same last element.
std::string short_name(const std::string& key, const CalibrateConfig& config) {
  const auto same = [&](const auto& other) { return last_element(other.first) == last_element(key); };
  return std::count_if(config.fit.begin(), config.fit.end(), same) == 1 ? last_element(key) : key;
}

}  // namespace

double six_digits(double value) {
  const std::string text = fmt::format("{:.6g}", value);
  double rounded = 0;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

double FittedParameter::u(double value) const { return log ? std::log(value) : 3 * value / (to - from); }

double FittedParameter::value(double u) const {
  return six_digits(std::clamp(log ? std::exp(u) : u * (to - from) / 3, from, to));
}

std::vector<FittedParameter> fitted_parameters(const CalibrateConfig& config) {
  std::vector<FittedParameter> parameters;
  for (const auto& [key, fit] : config.fit) {
    FittedParameter n;
    n.name = fit.as.empty() ? short_name(key, config) : fit.as;
    n.keys = keys_of(key, fit, config.experiments);
    n.units.resize(n.keys.size());
    n.from = fit.from->si;
    n.to = fit.to->si;
    n.log = fit.scale == FitScale::log || (fit.scale == FitScale::automatic && n.from > 0);
    n.start = fit.start ? fit.start->si : n.value(0.5 * (n.low() + n.high()));
    for (const FittedParameter& other : parameters)
      if (other.name == n.name) throw InputError(fmt::format("fit: two parameters are named '{}'; rename one of them with `as`", n.name));
    if (is_reserved_column(n.name) || n.name == "misfit" || n.name == "number" || n.name == "phase" || n.name.starts_with("misfit:"))
      throw InputError(fmt::format("fit: tables already have a column '{}'; rename this parameter with `as`", n.name));
    parameters.push_back(std::move(n));
  }
  return parameters;
}

}  // namespace tack
