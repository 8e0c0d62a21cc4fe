#include "framework/plot/table_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/config/nearest.hpp"
#include "framework/config/short_key.hpp"
#include "framework/output/file_names.hpp"
#include "framework/plot/axis_unit.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

double number_of(const std::string& text) { return csv_number(text).value_or(std::nan("")); }

// Returns the index of a column. Throws InputError with the nearest name.
size_t column_of(const CsvTexts& table, const std::string& name) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found == table.columns.end())
    throw InputError(fmt::format("the table has no column '{}'{}", name, suggestion(name, table.columns, "columns")));
  return static_cast<size_t>(found - table.columns.begin());
}

std::set<double> numbers_in(const CsvTexts& table, const std::string& column) {
  std::set<double> numbers;
  const size_t at = column_of(table, column);
  for (const auto& row : table.rows)
    if (const double v = number_of(row[at]); std::isfinite(v)) numbers.insert(v);
  return numbers;
}

// Returns true for numbers that span more than a decade: these need a logarithmic axis.
bool wide(const std::set<double>& numbers) { return !numbers.empty() && *numbers.begin() > 0 && *numbers.rbegin() / *numbers.begin() > 10; }

std::string unit_of(const std::string& column, const std::map<std::string, std::string>& units) {
  const auto found = units.find(column);
  return found == units.end() ? "" : found->second;
}

// Formats a cell for a legend: "0.3", "5 kPa"; other texts are unchanged.
std::string cell(const std::string& text, const std::string& unit) {
  const double number = unit.empty() ? std::nan("") : number_of(text);
  return std::isfinite(number) ? with_axis_unit(number, unit) : text;
}

}  // namespace

Plot table_plot(const CsvTexts& table, const TablePlot& what, const std::map<std::string, std::string>& units) {
  Plot plot;
  plot.title = what.y + " by " + short_key(what.x, table.columns);
  plot.x_label = what.x;
  plot.y_label = what.y;
  plot.x_unit = unit_of(what.x, units);
  plot.y_unit = unit_of(what.y, units);
  plot.log_x = what.log_x;
  plot.log_y = what.log_y;
  const size_t x = column_of(table, what.x), y = column_of(table, what.y);
  for (const size_t column : {x, y}) {
    const auto text = [&](const auto& row) { return !std::isfinite(number_of(row[column])); };
    if (!table.rows.empty() && std::all_of(table.rows.begin(), table.rows.end(), text))
      throw InputError(
          fmt::format("column '{}' has no numbers, and an axis needs them ('{}' in its first row); "
                      "values per name are drawn as `bars`, in `plots` of the batch file",
                      table.columns[column], table.rows.front()[column]));
  }
  std::vector<size_t> by;
  for (const std::string& name : what.by) by.push_back(column_of(table, name));
  std::vector<std::pair<std::string, std::map<double, std::vector<double>>>> groups;
  std::vector<std::string> left_out;
  for (const auto& row : table.rows) {
    const double at = number_of(row[x]), value = number_of(row[y]);
    if (!std::isfinite(at) || !std::isfinite(value)) {
      left_out.push_back(row.front());
      continue;
    }
    std::string title;
    for (size_t i = 0; i < by.size(); ++i) title += fmt::format("{}{} {}", i ? ", " : "", short_key(what.by[i], table.columns), cell(row[by[i]], unit_of(what.by[i], units)));
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == title; });
    if (group == groups.end()) group = groups.insert(groups.end(), {title, {}});
    group->second[at].push_back(value);
  }
  for (const auto& [title, points] : groups) {
    Curve curve{title, {}, {}};
    bool repeats = false;
    for (const auto& [at, values] : points) {
      double sum = 0;
      for (const double v : values) sum += v;
      curve.points.emplace_back(at, sum / static_cast<double>(values.size()));
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      curve.spread.emplace_back(*low, *high);
      repeats = repeats || values.size() > 1;
    }
    if (!repeats) curve.spread.clear();
    plot.curves.push_back(std::move(curve));
  }
  if (!left_out.empty())
    plot.notes.push_back(fmt::format("without a number: {}{}", fmt::join(left_out.begin(), left_out.begin() + static_cast<long>(std::min<size_t>(3, left_out.size())), "; "),
                                     left_out.size() > 3 ? fmt::format(" and {} more", left_out.size() - 3) : ""));
  return plot;
}

std::map<std::string, TablePlot> default_table_plots(const CsvTexts& table, const std::vector<std::string>& keys,
                                                     const std::vector<std::string>& statistics) {
  std::map<std::string, TablePlot> plots;
  FileNames names;
  for (const std::string& x : keys) {
    if (x == "repeat" || numbers_in(table, x).size() < 2) continue;
    for (const std::string& y : statistics) {
      if (numbers_in(table, y).empty()) continue;
      TablePlot plot{x, y, {}, wide(numbers_in(table, x)), wide(numbers_in(table, y))};
      for (const std::string& other : keys)
        if (other != x && other != "repeat") plot.by.push_back(other);
      plots[names.of(y + "_by_" + short_key(x, keys))] = plot;
    }
  }
  return plots;
}

}  // namespace tack
