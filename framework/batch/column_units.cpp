#include "framework/batch/column_units.hpp"

#include <fmt/format.h>

#include "framework/config/parse.hpp"
#include "framework/config/units.hpp"
#include "framework/config/written_number.hpp"
#include "framework/core/phase_clock.hpp"
#include "framework/output/probe_units.hpp"

namespace tack {
namespace {

using Units = std::map<std::string, std::string>;

std::string unit_of(const StatisticQuery& query, const Units& probes) {
  const auto of = [&](const std::string& column) {
    const auto found = probes.find(column);
    return Unit{found == probes.end() ? std::string_view("1") : std::string_view(found->second), ""};
  };
  return unit_of(query.statistic, of(query.probe), of(query.along));
}

}  // namespace

std::string unit_in(const std::string& comment) {
  if (!comment.starts_with('[')) return comment;
  const size_t from = comment.find(", ") + 2;
  return comment.substr(from, comment.size() - 1 - from);
}

Units column_units(const Experiment& experiment, const Value& resolved, const Variant& variant, const std::vector<BatchStatistic>& statistics) {
  Units units{{"wall_seconds", "s"}, {"process_seconds", "s"}, {"cpu_seconds", "s"}, {"memory_mb", "MB"}, {"min_distance", "m"}, {"min_gap", "m"}};
  for (const auto& phase : phase_names) units[fmt::format("seconds_{}", phase)] = "s";
  for (const Variant::Shown& shown : variant.shown)
    if (const Value* value = shown.key.empty() ? nullptr : value_at(resolved, shown.key); value && value->is_scalar())
      if (const std::optional<WrittenNumber> written = written_number(value->text)) units[shown.column] = written->unit.empty() ? unit_in(value->comment) : written->unit;
  Units probes = probe_units(experiment.probes);
  probes["time"] = "s";
  for (const BatchStatistic& s : statistics) units[s.column()] = unit_of(s.resolved(), probes);
  if (statistics.empty())
    for (const auto& [column, unit] : probes)
      if (column != "time")
        for (const Statistic statistic : {Statistic::final, Statistic::min, Statistic::max})
          units[fmt::format("{}.{}", column, to_string(statistic))] = unit;
  for (const Expectation& e : experiment.expect) units["value:" + name_of(e)] = unit_of(e.resolved(), probes);
  std::erase_if(units, [](const auto& one) { return one.second.empty() || one.second == "1"; });
  return units;
}

}  // namespace tack
