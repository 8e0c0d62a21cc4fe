#include "framework/batch/batch_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/batch/column_units.hpp"
#include "framework/batch/resolved_case.hpp"
#include "framework/batch/results_table.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/retired_keys.hpp"
#include "framework/config/short_key.hpp"
#include "framework/config/units.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "geometry/checksum.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr size_t name_length_max = 100;                                // of a case
constexpr size_t errors_max = 10;
constexpr double cases_max = 100000;

// Returns "1 MPa" as 1000000, so that tables can be plotted; a text without a number is unchanged.
std::string cell_text(const std::string& text) {
  try {
    return fmt::format("{}", to_si(text, units::any));
  } catch (const InputError&) {
    return text;
  }
}

// Returns the name of a case with these values, which does not depend on the other cases: a case
// that is planned again with others keeps its results.
std::string name_of(const std::vector<std::pair<std::string, std::string>>& parts) {
  const std::string name = case_name(parts);
  if (name.empty()) return "case";
  return name.size() <= name_length_max ? name : fmt::format("case_{:08x}", crc32_of(name.data(), name.size()));
}

// Makes names unique: the second "a" becomes "a.2".
class Names {
 public:
  std::string free(const std::string& name) {
    int& number = numbers_[name];  // of the last duplicate
    for (;;) {
      std::string tried = ++number == 1 ? name : fmt::format("{}.{}", name, number);
      if (taken_.insert(tried).second) return tried;
    }
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> numbers_;
};

std::vector<Variant> all_variants(const BatchConfig& config) {
  double count = static_cast<double>(config.all_bases().size());
  for (const auto& variation : config.vary) count *= variation->count();
  if (count > cases_max)
    throw InputError(fmt::format("vary: that makes {:.6g} cases, and {:.6g} are the most; vary fewer keys or values, or make several batches",
                                 count, cases_max));
  std::vector<Variant> all{{}};
  for (const auto& variation : config.vary) {
    std::vector<Variant> next;
    const std::vector<Variant> more = variation->variants();
    for (const Variant& a : all)
      for (const Variant& b : more) next.push_back(joined(a, b));
    all = std::move(next);
  }
  return all;
}

void refuse_columns_twice(const Variant& variant) {
  for (size_t i = 0; i < variant.shown.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      if (variant.shown[i].column == variant.shown[k].column)
        throw InputError(fmt::format("vary: two entries vary '{}'; name one of them otherwise with `as`, or take it out",
                                     variant.shown[i].column));
}

// Throws for columns whose names are fixed columns of results.csv, or those of statistics.
void refuse_taken_columns(const std::vector<std::string>& columns, const std::vector<BatchStatistic>& statistics) {
  for (const std::string& column : columns) {
    if (is_reserved_column(column))
      throw InputError(fmt::format("vary: results.csv has a column '{}' already; name this one otherwise with `as`", column));
    if (std::any_of(statistics.begin(), statistics.end(), [&](const BatchStatistic& s) { return s.column() == column; }))
      throw InputError(fmt::format("vary: a statistic and a varied key would both be the column '{}'; give the statistic another `name`, or the key another one with `as`", column));
  }
}

class Planner {
 public:
  Planner(const BatchConfig& config, const std::string& program, const PlanProgress& progress)
      : config_(config), progress_(progress), variants_(all_variants(config)), resolver_(program) {
    refuse_columns_twice(variants_.front());
    for (const Variant::Shown& s : variants_.front().shown) columns_.push_back(s.column);
    refuse_taken_columns(columns_, config.statistics);
    plan_.name = config.name;
    plan_.about = config.about;
    plan_.statistics = config.statistics;
    plan_.plots = config.plots;
  }

  BatchPlan plan() {
    const std::vector<BatchBase> bases = config_.all_bases();
    several_ = bases.size() > 1;
    if (several_) plan_.columns.push_back("base");
    plan_.columns.insert(plan_.columns.end(), columns_.begin(), columns_.end());
    for (const BatchBase& base : bases) add_base(base);
    if (!errors_.empty()) throw InputError(fmt::format("{}", fmt::join(errors_, "\n")));
    return std::move(plan_);
  }

 private:
  void add_base(const BatchBase& base) {
    Value root;
    try {
      root = parse_file(base.file);
      for (const auto* list : {&config_.set, &base.set})
        for (const std::string& assignment : *list) apply_override(root, assignment);
    } catch (const InputError& error) {
      return note(error, "");
    }
    for (const Variant& variant : variants_) {
      if (errors_.size() >= errors_max) return;
      add_case(base, root, variant);
      if (progress_) progress_(plan_.cases.size(), variants_.size() * config_.all_bases().size());
    }
  }

  void add_case(const BatchBase& base, Value root, const Variant& variant) {
    BatchCase one;
    std::vector<std::pair<std::string, std::string>> parts;
    if (several_) {
      one.values["base"] = base.name;
      parts.push_back({"base", base.name});
    }
    for (const Variant::Shown& s : variant.shown) {
      one.values[s.column] = cell_text(s.text);
      parts.push_back({short_key(s.column, columns_), s.text});
    }
    one.base = base.name;
    one.name = names_.free(name_of(parts));
    try {
      ResolvedCase made = resolver_.resolve(std::move(root), variant.set);
      const Experiment& experiment = made.loaded.experiment;
      one.duration = experiment.time.duration;
      one.may_end_early = !experiment.protocols.empty();
      one.checkpoints = experiment.output.checkpoint_interval.has_value();
      if (plan_.cases.empty() || plan_.cases.back().base != base.name) {
        need_stages(experiment.protocols);
        add_units(column_units(experiment, made.resolved, variant, config_.statistics));
        add_warnings(retired_key_texts(made.loaded.root, fields_of(experiment)));
      }
      one.scene = std::move(made.scene);
      one.digest = std::move(made.digest);
    } catch (const InputError& error) {
      return note(error, one.name);
    }
    plan_.cases.push_back(std::move(one));
  }

  void need_stages(const std::vector<ProtocolConfig>& protocols) const {
    for (const BatchStatistic& s : config_.statistics) try {
        if (!s.stage.empty()) need_stage(protocols, s.stage);
      } catch (const InputError& error) {
        throw InputError(fmt::format("statistic '{}': {}", s.column(), error.what()));
      }
  }

  // Adds the units of the first case of a base; columns whose units differ between bases lose
  // theirs.
  void add_units(const std::map<std::string, std::string>& units) {
    if (plan_.cases.empty()) plan_.units = units;
    std::erase_if(plan_.units, [&](const auto& one) {
      const auto found = units.find(one.first);
      return found == units.end() || found->second != one.second;
    });
  }

  void add_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& one : warnings)
      if (std::find(plan_.warnings.begin(), plan_.warnings.end(), one) == plan_.warnings.end()) plan_.warnings.push_back(one);
  }

  // Notes an error; an error of many cases is noted once.
  void note(const InputError& error, const std::string& name) {
    const std::string what = error.what();
    if (std::find(noted_.begin(), noted_.end(), what) != noted_.end()) return;
    noted_.push_back(what);
    errors_.push_back(name.empty() ? what : fmt::format("{} (case '{}')", what, name));
  }

  const BatchConfig& config_;
  const PlanProgress& progress_;
  std::vector<Variant> variants_;
  std::vector<std::string> columns_;
  bool several_ = false;
  BatchPlan plan_;
  Names names_;
  CaseResolver resolver_;
  std::vector<std::string> errors_, noted_;
};

}  // namespace

std::string case_name(const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string name;
  for (const auto& [key, text] : parts) name += (name.empty() ? "" : ",") + key + "=" + text;
  std::erase_if(name, [](char c) { return std::string_view("[]{}'\" ").find(c) != std::string_view::npos; });
  std::replace(name.begin(), name.end(), ':', '=');
  for (char& c : name)
    if (const auto byte = static_cast<unsigned char>(c); byte < 0x80 && !std::isalnum(byte) && std::string_view("-_.,=+").find(c) == std::string_view::npos) c = '_';
  return name;
}

BatchPlan plan_of(const BatchConfig& config, const std::string& program, const PlanProgress& progress) {
  return Planner(config, program, progress).plan();
}

void check_case(const BatchPlan& plan, const BatchCase& one) {
  BuiltExperiment built(parse_experiment(one.scene, fmt::format("case '{}'", one.name)));
  const ProbeSet probes = probes_of(built);
  std::vector<std::string> columns{"time"};
  columns.insert(columns.end(), probes.columns().begin(), probes.columns().end());
  for (const BatchStatistic& s : plan.statistics) try {
      evaluate(s.resolved(), ProbeSeries{columns, {}});
    } catch (const InputError& error) {
      throw InputError(fmt::format("statistic '{}': {}", s.column(), error.what()));
    }
}

}  // namespace tack
