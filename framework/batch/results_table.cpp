#include "framework/batch/results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "framework/output/probes_csv.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

// The columns of one role in the order of their first appearance.
class Cells {
 public:
  Cells(ColumnRole role, size_t rows) : role_(role), rows_(rows) {}

  void set(size_t row, const std::string& column, std::string text) {
    ResultsColumn& c = at(column);
    if (c.texts.empty()) c.texts.resize(rows_);
    c.texts[row] = std::move(text);
  }
  void set(size_t row, const std::string& column, double number) {
    ResultsColumn& c = at(column);
    if (c.numbers.empty()) c.numbers.resize(rows_, std::numeric_limits<double>::quiet_NaN());
    if (std::isfinite(number)) c.numbers[row] = number;
  }
  void set(size_t row, const std::string& column, const Json& number) {
    if (number.is_number()) set(row, column, number.get<double>());
  }
  void append_to(ResultsTable& table) {
    std::move(columns_.begin(), columns_.end(), std::back_inserter(table.columns));
  }

 private:
  ResultsColumn& at(const std::string& column) {
    const auto [known, is_new] = index_.try_emplace(column, columns_.size());
    if (is_new) columns_.push_back({column, role_, {}, {}});
    return columns_[known->second];
  }

  ColumnRole role_;
  size_t rows_;
  std::vector<ResultsColumn> columns_;
  std::unordered_map<std::string, size_t> index_;
};

void add_expectations(Cells& cells, size_t row, const Json& summary) {
  for (const Json& e : summary.at("expect")) {
    const std::string name = e.at("name");
    cells.set(row, "expect:" + name, e.at("pass") ? 1.0 : 0.0);
    cells.set(row, "value:" + name, e.at("value"));
  }
}

// Returns why some have no value.
std::vector<std::string> add_statistics(Cells& cells, size_t row, const BatchPlan& plan, const std::filesystem::path& run) {
  const ProbeSeries series = read_csv(run / "probes.csv");
  const bool staged = std::any_of(plan.statistics.begin(), plan.statistics.end(), [](const BatchStatistic& s) { return !s.stage.empty(); });
  const std::vector<StageVisit> visits = staged ? read_stages(run / "stages.csv") : std::vector<StageVisit>();
  std::vector<std::string> problems;
  for (const BatchStatistic& s : plan.statistics) {
    const StatisticValue found = s.value(series, visits);
    cells.set(row, s.column(), found.value);
    if (!found.problem.empty()) problems.push_back(fmt::format("statistic '{}': {}", s.column(), found.problem));
  }
  if (!plan.statistics.empty()) return problems;
  for (const std::string& column : series.columns) {
    if (column == "time") continue;
    using enum Statistic;
    for (const Statistic statistic : {final, min, max})
      cells.set(row, fmt::format("{}.{}", column, to_string(statistic)), evaluate(StatisticQuery{statistic, column, "time", 0, {}}, series).value);
  }
  return problems;
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

std::string_view to_string(ColumnRole role) {
  static constexpr std::string_view names[] = {"name", "parameter", "status", "expectation", "statistic", "count", "cost"};
  return names[static_cast<size_t>(role)];
}

std::string ResultsColumn::cell(size_t row) const {
  if (!is_number()) return texts[row];
  return std::isfinite(numbers[row]) ? fmt::format("{}", numbers[row]) : std::string();
}

ResultsTable results_of(const BatchFolder& folder, const BatchPlan& plan, const std::vector<CaseState>& case_states) {
  const size_t rows = plan.cases.size();
  using enum ColumnRole;
  Cells names(name, rows), varied(parameter, rows), states(status, rows), expectations(expectation, rows), statistics(statistic, rows), counts(count, rows), costs(cost, rows);
  for (size_t row = 0; row < rows; ++row) {
    const BatchCase& one = plan.cases[row];
    const CaseState& state = case_states[row];
    names.set(row, "case", one.name);
    for (const std::string& column : plan.columns) {
      const auto found = one.values.find(column);
      varied.set(row, column, found == one.values.end() ? std::string() : found->second);
    }
    states.set(row, "status", std::string(to_string(state.status)));
    states.set(row, "error", state.error);
    if (!finished(state.status)) continue;
    std::ifstream in(folder.run(one.name) / "summary.json");
    const Json summary = Json::parse(in, nullptr, false);
    if (in.is_open() && !summary.is_object()) states.set(row, "error", std::string("summary.json is damaged (no JSON)"));
    if (summary.is_object()) try {
        add_counts(counts, row, summary);
        add_seconds(costs, row, summary);
        if (state.status == CaseStatus::done || state.status == CaseStatus::expectation_failed) {
          add_expectations(expectations, row, summary);
          const std::vector<std::string> problems = add_statistics(statistics, row, plan, folder.run(one.name));
          if (state.error.empty() && !problems.empty()) states.set(row, "error", fmt::format("{}", fmt::join(problems, "; ")));
        }
      } catch (const Json::exception& error) {
        states.set(row, "error", fmt::format("summary.json is damaged ({})", error.what()));
      } catch (const InputError& error) {
        states.set(row, "error", std::string(error.what()));
      }
    costs.set(row, "process_seconds", state.wall_seconds);
    costs.set(row, "cpu_seconds", state.cpu_seconds);
    costs.set(row, "memory_mb", state.memory_mb);
  }
  ResultsTable table{rows, {}};
  if (rows == 0) table.columns.push_back({"case", name, {}, {}});
  for (Cells* cells : {&names, &varied, &states, &expectations, &statistics, &counts, &costs}) cells->append_to(table);
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
  const auto add_row = [&](const auto& cell_of) {
    for (size_t k = 0; k < table.columns.size(); ++k) text += (k ? "," : "") + csv_cell(cell_of(table.columns[k]));
    text += "\n";
  };
  add_row([](const ResultsColumn& c) { return c.name; });
  for (size_t row = 0; row < table.rows; ++row) add_row([&](const ResultsColumn& c) { return c.cell(row); });
  return text;
}

}  // namespace tack
