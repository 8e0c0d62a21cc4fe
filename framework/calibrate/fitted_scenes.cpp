#include "framework/calibrate/fitted_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/batch/column_units.hpp"
#include "framework/calibrate/run_gradients.hpp"
#include "framework/config/retired_keys.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/words.hpp"
#include "framework/config/written_number.hpp"
#include "geometry/checksum.hpp"
#include "framework/sensitivity/gradients.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr size_t case_name_max = 100;  // characters
// Finite-difference step of sensitivities in u, for linear scales, where a value may be zero.
constexpr double gradient_step = 1e-6;

Variant::Setting setting(const std::string& key, const std::string& text, const std::string& origin) {
  Value value = Value::scalar(text);
  value.mark.file = std::make_shared<const std::string>(origin);
  return {key, std::move(value)};
}

Variant::Setting without_frames() { return setting("output.frames", "false", "the calibration"); }

std::string number_text(double value) { return fmt::format("{:.6g}", value); }

std::optional<WrittenNumber> number_of(const Value* value) { return value && value->is_scalar() ? written_number(value->text) : std::nullopt; }

// Returns the unit of a parameter, which the scene has in base units. It is the unit of the fit's
// range, "Pa" of "50 kPa", if the range has a unit of the same dimension, else `unit`.
std::string named_unit(const std::string& unit, const std::optional<Quantity>& bound) {
  const std::optional<WrittenNumber> written = bound ? written_number(bound->written) : std::nullopt;
  return written && base_dimension(written->unit) == base_dimension(unit) ? written->unit : unit;
}

// Returns the longest prefix of a key that the scene has: "contact.pairs" for "contact.pairs.x".
std::string known_prefix(const Value& scene, const std::string& key) {
  std::string prefix = key;
  while (!prefix.empty() && !value_at(scene, prefix)) prefix = prefix.substr(0, prefix.rfind('.') == prefix.npos ? 0 : prefix.rfind('.'));
  return prefix;
}

}  // namespace

FittedScenes::FittedScenes(const CalibrateConfig& config, const std::string& program) : parameters_(fitted_parameters(config)), resolver_(program) {
  for (int e = 0; e < static_cast<int>(config.experiments.size()); ++e) run_of_.push_back(scene_of(config, e));
  const DesignPoint values = start();
  for (int e = 0; e < static_cast<int>(config.experiments.size()); ++e) {
    const std::string& name = config.experiments[static_cast<size_t>(e)].name;
    try {
      const Scene& scene = scenes_[static_cast<size_t>(run_of(e))];
      check_keys(e, resolver_.resolve(scene.root, {}).resolved, config);
      const ResolvedCase resolved_case = resolved(run_of(e), values, {without_frames()});
      if (scene.experiment == e) {
        check_case({}, {name, name, {}, resolved_case.scene, "", 0});
        for (std::string& line : retired_key_texts(resolved_case.loaded.root, fields_of(resolved_case.loaded.experiment))) warnings_.push_back(std::move(line));
      }
      measured_.push_back(measured_points(config.experiments[static_cast<size_t>(e)], resolved_case.loaded.experiment));
    } catch (const InputError& error) {
      const std::string what = error.what();
      throw InputError(what.find("experiment '" + name + "'") == what.npos ? fmt::format("experiment '{}': {}", name, what) : what);
    }
  }
}

// Returns the scene of an earlier experiment with equal file, overrides and keys, or a new one.
int FittedScenes::scene_of(const CalibrateConfig& config, int experiment) {
  const auto& all = config.experiments;
  const MeasuredExperiment& mine = all[static_cast<size_t>(experiment)];
  for (size_t k = 0; k < scenes_.size(); ++k) {
    const MeasuredExperiment& other = all[static_cast<size_t>(scenes_[k].experiment)];
    const auto same_keys = [&](const FittedParameter& n) { return n.keys[static_cast<size_t>(experiment)] == n.keys[static_cast<size_t>(scenes_[k].experiment)]; };
    if (other.base == mine.base && other.set == mine.set && std::all_of(parameters_.begin(), parameters_.end(), same_keys)) return static_cast<int>(k);
  }
  Scene scene{mine.name, parse_file(mine.base), experiment};
  for (const auto* list : {&config.set, &mine.set})
    for (const std::string& assignment : *list) apply_override(scene.root, assignment);
  scenes_.push_back(std::move(scene));
  return static_cast<int>(scenes_.size()) - 1;
}

void FittedScenes::check_keys(int experiment, const Value& resolved, const CalibrateConfig& config) {
  auto fit = config.fit.begin();  // in the order of the parameters
  for (FittedParameter& n : parameters_) {
    const auto& [name, range] = *fit++;
    for (const std::string& key : n.keys[static_cast<size_t>(experiment)]) {
      const Value* value = value_at(resolved, key);
      if (!value) {
        const std::string prefix = known_prefix(resolved, key);
        throw InputError(fmt::format("fit '{}': the scene has no key '{}'{}; if only another experiment has it, say which one: keys: {{NAME: {}}}", name, key,
                                     prefix.empty() ? "" : fmt::format(" (it has '{}')", prefix), key));
      }
      const std::optional<WrittenNumber> written = number_of(value);
      if (!written) throw InputError(fmt::format("fit '{}': '{}' is {}, and not a number", name, key, value->description()));
      n.units[static_cast<size_t>(experiment)].push_back(written->unit);
      const std::string in_comment = value->comment.empty() ? "1" : unit_in(value->comment);
      const std::string unit = written->unit.empty() ? in_comment : named_unit(written->unit, range.from);
      for (const auto& [what, bound] : {std::pair("from", range.from), std::pair("to", range.to), std::pair("start", range.start)}) try {
          if (bound) bound->check(Unit{unit, "number"});
        } catch (const InputError& error) {
          throw InputError(fmt::format("fit '{}': {}: {}", name, what, error.what()));
        }
      if (n.unit.empty()) n.unit = unit;
      if (base_dimension(n.unit) != base_dimension(unit)) throw InputError(fmt::format("fit '{}': '{}' is in {}, another of its keys in {}", name, key, unit, n.unit));
    }
  }
}

std::vector<Variant::Setting> FittedScenes::settings(int run, const DesignPoint& values) const {
  std::vector<Variant::Setting> set;
  const size_t experiment = static_cast<size_t>(scenes_[static_cast<size_t>(run)].experiment);
  for (size_t i = 0; i < parameters_.size(); ++i) {
    const std::vector<std::string>&keys = parameters_[i].keys[experiment], &units = parameters_[i].units[experiment];
    for (size_t k = 0; k < keys.size(); ++k)
      set.push_back(setting(keys[k], number_text(values[i]) + (units[k].empty() ? "" : " " + units[k]), fmt::format("fit '{}'", parameters_[i].name)));
  }
  return set;
}

ResolvedCase FittedScenes::resolved(int run, const DesignPoint& values, const std::vector<Variant::Setting>& more) {
  std::vector<Variant::Setting> set = settings(run, values);
  set.insert(set.end(), more.begin(), more.end());
  ResolvedCase resolved_case = resolver_.resolve(scenes_[static_cast<size_t>(run)].root, set);
  const size_t experiment = static_cast<size_t>(scenes_[static_cast<size_t>(run)].experiment);
  for (size_t i = 0; i < parameters_.size(); ++i)
    for (const std::string& key : parameters_[i].keys[experiment]) {
      const std::optional<WrittenNumber> taken = number_of(value_at(resolved_case.resolved, key));
      if (!taken || six_digits(taken->si) != six_digits(values[i]))
        throw InputError(fmt::format("fit '{}': the scene does not take {} for '{}'", parameters_[i].name, number_text(values[i]), key));
    }
  return resolved_case;
}

const std::vector<std::string>& FittedScenes::keys_of(const FittedParameter& parameter, int run) const {
  return parameter.keys[static_cast<size_t>(scenes_[static_cast<size_t>(run)].experiment)];
}

GradientConfig FittedScenes::gradient_of(const FittedParameter& parameter, const std::string& key) const {
  GradientConfig one;
  one.key = key;
  if (!parameter.log) one.step = gradient_step * parameter.slope(0);
  return one;
}

const std::vector<std::string>& FittedScenes::without_derivatives() {
  if (without_) return *without_;
  without_.emplace(parameters_.size());
  for (int run = 0; run < runs(); ++run) {
    const BuiltExperiment built(resolved(run, start(), {without_frames()}).loaded);
    for (size_t i = 0; i < parameters_.size(); ++i)
      for (const std::string& key : keys_of(parameters_[i], run))
        if ((*without_)[i].empty()) (*without_)[i] = Gradients::reason_without(built, gradient_of(parameters_[i], key));
  }
  return *without_;
}

BatchCase FittedScenes::case_of(int run, const DesignPoint& values, bool derivatives) {
  std::vector<Variant::Setting> more{without_frames()};
  std::vector<GradientConfig> gradients;
  for (size_t i = 0; derivatives && i < parameters_.size(); ++i)
    if (without_derivatives()[i].empty())
      for (const std::string& key : keys_of(parameters_[i], run)) gradients.push_back(gradient_of(parameters_[i], key));
  if (!gradients.empty()) more.push_back({"output.gradients", gradients_value(gradients)});
  ResolvedCase resolved_case = resolved(run, values, more);
  BatchCase one;
  one.base = run_name(run);
  std::vector<std::pair<std::string, std::string>> name_values;
  if (runs() > 1) name_values.emplace_back("base", one.base), one.values["base"] = one.base;
  for (size_t i = 0; i < parameters_.size(); ++i) {
    name_values.emplace_back(parameters_[i].name, number_text(values[i]));
    one.values[parameters_[i].name] = number_text(values[i]);
  }
  if (!gradients.empty()) name_values.emplace_back("derivatives", "true");
  one.name = case_name(name_values);
  if (one.name.size() > case_name_max) one.name = fmt::format("{}-{:08x}", one.name.substr(0, case_name_max / 2), crc32_of(one.name.data(), one.name.size()));
  one.scene = std::move(resolved_case.scene);
  one.digest = std::move(resolved_case.digest);
  one.duration = resolved_case.loaded.experiment.time.duration;
  one.may_end_early = !resolved_case.loaded.experiment.protocols.empty();
  return one;
}

std::string FittedScenes::scene_text(int run, const DesignPoint& values) { return resolved(run, values, {}).scene; }

// Returns d residuals / d u of all experiments; empty if a run has none.
std::vector<double> FittedScenes::derivatives(size_t parameter, double value, const std::vector<ProbeSeries>& series, const std::vector<ProbeSeries>& gradients) const {
  std::vector<double> all;
  for (size_t k = 0; k < measured_.size(); ++k) {
    const size_t run = static_cast<size_t>(run_of_[k]);
    const std::vector<std::string>& keys = parameters_[parameter].keys[k];
    std::vector<double> change(measured_[k].curve.size(), 0);
    if (!keys.empty()) {
      const std::vector<double> dx = gradient_column(gradients[run], measured_[k].x, keys), dy = gradient_column(gradients[run], measured_[k].y, keys);
      if (dx.size() != series[run].rows.size() || dy.size() != dx.size()) return {};
      change = measured_[k].derivatives(series[run], dx, dy);
    }
    for (const double one : change) all.push_back(one * parameters_[parameter].slope(value));
  }
  return all;
}

PointEvaluation FittedScenes::evaluation(const DesignPoint& values, bool derivatives, const std::vector<std::filesystem::path>& run_folders) const {
  PointEvaluation e;
  e.values = values;
  e.asked_derivatives = derivatives;
  double misfit = 0;
  try {
    std::vector<ProbeSeries> series, gradients;
    for (const auto& folder : run_folders) {
      series.push_back(read_csv(folder / "probes.csv"));
      if (derivatives) gradients.push_back(std::filesystem::exists(folder / "gradients.csv") ? read_csv(folder / "gradients.csv") : ProbeSeries{});
    }
    for (size_t i = 0; derivatives && i < parameters_.size(); ++i) e.derivatives.push_back(this->derivatives(i, values[i], series, gradients));
    for (size_t k = 0; k < measured_.size(); ++k) {
      int beyond = 0;
      const std::vector<double> r = measured_[k].residuals(measured_[k].simulated(series[static_cast<size_t>(run_of_[k])], beyond));
      double squares = 0;
      for (const double one : r) squares += one * one;
      e.residuals.insert(e.residuals.end(), r.begin(), r.end());
      e.misfits.push_back(squares);
      e.beyond.push_back(beyond);
      misfit += squares;
    }
  } catch (const InputError& error) {
    PointEvaluation bad;
    bad.values = values;
    bad.asked_derivatives = derivatives;
    bad.status = "not comparable";
    bad.error = error.what();
    return bad;
  }
  e.good = true;
  e.status = "done";
  e.misfit = misfit;
  return e;
}

DesignPoint FittedScenes::start() const {
  DesignPoint values;
  for (const FittedParameter& n : parameters_) values.push_back(six_digits(n.start));
  return values;
}

std::string values_text(const std::vector<FittedParameter>& parameters, const DesignPoint& values) {
  std::string text;
  for (size_t i = 0; i < parameters.size(); ++i)
    text += fmt::format("{}{} {}{}", i ? ", " : "", parameters[i].name, number_text(values[i]), parameters[i].unit == "1" || parameters[i].unit.empty() ? "" : " " + parameters[i].unit);
  return text;
}

}  // namespace tack
