#include "framework/batch/results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/output/probes_csv.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

// The columns of one group in the order of their first appearance.
class Cells {
 public:
  void set(size_t row, const std::string& column, std::string text) {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    const size_t k = static_cast<size_t>(found - columns_.begin());
    if (found == columns_.end()) columns_.push_back(column);
    if (cells_.size() <= row) cells_.resize(row + 1);
    if (cells_[row].size() <= k) cells_[row].resize(k + 1);
    cells_[row][k] = std::move(text);
  }
  void set(size_t row, const std::string& column, double number) {
    set(row, column, std::isfinite(number) ? fmt::format("{}", number) : std::string());
  }
  void set(size_t row, const std::string& column, const Json& number) {
    if (number.is_number()) set(row, column, number.get<double>());
  }
  void append_to(ResultsTable& table) const {
    table.columns.insert(table.columns.end(), columns_.begin(), columns_.end());
    for (size_t row = 0; row < table.rows.size(); ++row)
      for (size_t k = 0; k < columns_.size(); ++k)
        table.rows[row].push_back(row < cells_.size() && k < cells_[row].size() ? cells_[row][k] : "");
  }

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> cells_;
};

void add_expectations(Cells& cells, size_t row, const Json& summary) {
  for (const Json& e : summary.at("expect")) {
    const std::string name = e.at("name");
    cells.set(row, "expect:" + name, std::string(e.at("pass") ? "1" : "0"));
    cells.set(row, "value:" + name, e.at("value"));
  }
}

void add_statistics(Cells& cells, size_t row, const BatchPlan& plan, const std::filesystem::path& probes) {
  const ProbeSeries series = read_csv(probes);
  for (const BatchStatistic& s : plan.statistics) cells.set(row, s.column(), evaluate(s.resolved(), series).value);
  if (!plan.statistics.empty()) return;
  for (const std::string& column : series.columns) {
    if (column == "time") continue;
    using enum Statistic;
    for (const Statistic statistic : {final, min, max})
      cells.set(row, fmt::format("{}.{}", column, to_string(statistic)), evaluate(StatisticQuery{statistic, column, "time", 0, {}}, series).value);
  }
}

void add_counts(Cells& cells, size_t row, const Json& summary) {
  cells.set(row, "steps", summary.at("steps"));
  cells.set(row, "dofs", summary.at("dofs"));
  for (const char* key : {"newton_iterations", "linear_solves", "linear_iterations"}) cells.set(row, key, summary.at("totals").at(key));
  for (const char* key : {"failed_solves", "max_contacts", "min_distance", "min_gap", "intersections", "inverted_tets"})
    if (summary.contains(key)) cells.set(row, key, summary.at(key));
  if (const auto warnings = summary.find("warnings"); warnings != summary.end()) cells.set(row, "warnings", Json(warnings->size()));
}

void add_seconds(Cells& cells, size_t row, const Json& summary) {
  cells.set(row, "wall_seconds", summary.at("wall_seconds"));
  for (const auto& [phase, seconds] : summary.at("phases").items()) cells.set(row, "seconds_" + phase, seconds);
}

}  // namespace

ResultsTable results_of(const BatchFolder& folder, const BatchPlan& plan) {
  ResultsTable table{{"case"}, {}};
  Cells varied, status, expectations, statistics, counts, measured;
  for (size_t row = 0; row < plan.cases.size(); ++row) {
    const BatchCase& one = plan.cases[row];
    const CaseState state = state_of(folder, one);
    table.rows.push_back({one.name});
    for (const std::string& column : plan.columns) {
      const auto found = one.values.find(column);
      varied.set(row, column, found == one.values.end() ? std::string() : found->second);
    }
    status.set(row, "status", std::string(to_string(state.status)));
    status.set(row, "error", state.error);
    if (!finished(state.status)) continue;
    std::ifstream in(folder.run(one.name) / "summary.json");
    const Json summary = Json::parse(in, nullptr, false);
    if (summary.is_object()) try {
        add_counts(counts, row, summary);
        add_seconds(measured, row, summary);
        if (state.status == CaseStatus::done || state.status == CaseStatus::expectation_failed) {
          add_expectations(expectations, row, summary);
          add_statistics(statistics, row, plan, folder.run(one.name) / "probes.csv");
        }
      } catch (const Json::exception& error) {
        status.set(row, "error", fmt::format("summary.json is damaged ({})", error.what()));
      } catch (const InputError& error) {
        status.set(row, "error", std::string(error.what()));
      }
    measured.set(row, "process_seconds", state.wall_seconds);
    measured.set(row, "cpu_seconds", state.cpu_seconds);
    measured.set(row, "memory_mb", state.memory_mb);
  }
  for (const Cells* cells : {&varied, &status, &expectations, &statistics, &counts, &measured}) cells->append_to(table);
  return table;
}

bool is_reserved_column(const std::string& name) {
  static constexpr std::string_view fixed[] = {"case", "base", "status", "error", "steps", "dofs", "newton_iterations", "linear_solves",
                                               "linear_iterations", "failed_solves", "max_contacts", "min_distance", "min_gap", "intersections", "inverted_tets", "warnings",
                                               "wall_seconds", "process_seconds", "cpu_seconds", "memory_mb"};
  return std::find(std::begin(fixed), std::end(fixed), name) != std::end(fixed) || name.starts_with("expect:") || name.starts_with("value:") ||
         name.starts_with("seconds_");
}

std::string csv_text(const ResultsTable& table) {
  std::string text;
  const auto add = [&](const std::vector<std::string>& row) {
    for (size_t i = 0; i < row.size(); ++i) text += (i ? "," : "") + csv_cell(row[i]);
    text += "\n";
  };
  add(table.columns);
  for (const auto& row : table.rows) add(row);
  return text;
}

}  // namespace tack
