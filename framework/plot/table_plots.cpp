#include "framework/plot/table_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "framework/config/nearest.hpp"
#include "framework/output/csv.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

double number_of(const std::string& text) {
  double number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  return status == std::errc() && end == text.data() + text.size() && !text.empty() ? number : std::nan("");
}

std::string file_name(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
  return text;
}

// The last part of a key: "young" of "objects.cube.energies.0.young".
std::string short_name(const std::string& key) { return key.substr(key.rfind('.') + 1); }

std::set<double> numbers_in(const TextTable& table, const std::string& column) {
  std::set<double> numbers;
  const size_t at = table.column(column);
  for (const auto& row : table.rows)
    if (const double v = number_of(row[at]); std::isfinite(v)) numbers.insert(v);
  return numbers;
}

// What spans more than a decade is better seen on a logarithmic axis.
bool wide(const std::set<double>& numbers) { return !numbers.empty() && *numbers.begin() > 0 && *numbers.rbegin() / *numbers.begin() > 10; }

}  // namespace

std::size_t TextTable::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end())
    throw InputError(fmt::format("the table has no column '{}'{}", name, suggestion(name, columns, "columns")));
  return static_cast<std::size_t>(found - columns.begin());
}

TextTable read_text_table(const std::filesystem::path& path) {
  const auto rows = read_csv_cells(path);
  if (rows.empty()) throw InputError(fmt::format("{}: is empty", path.string()));
  TextTable table{rows.front(), {rows.begin() + 1, rows.end()}};
  for (auto& row : table.rows) row.resize(table.columns.size());
  return table;
}

Plot table_plot(const TextTable& table, const TablePlot& what) {
  Plot plot;
  plot.title = what.y + " by " + short_name(what.x);
  plot.x_label = what.x;
  plot.y_label = what.y;
  plot.log_x = what.log_x;
  plot.log_y = what.log_y;
  const size_t x = table.column(what.x), y = table.column(what.y);
  std::vector<size_t> by;
  for (const std::string& name : what.by) by.push_back(table.column(name));
  std::vector<std::pair<std::string, std::map<double, std::vector<double>>>> groups;
  std::vector<std::string> left_out;
  for (const auto& row : table.rows) {
    const double at = number_of(row[x]), value = number_of(row[y]);
    if (!std::isfinite(at) || !std::isfinite(value)) {
      left_out.push_back(row.front());
      continue;
    }
    std::string title;
    for (size_t i = 0; i < by.size(); ++i) title += fmt::format("{}{} {}", i ? ", " : "", short_name(what.by[i]), row[by[i]]);
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

std::map<std::string, TablePlot> default_table_plots(const TextTable& table, const std::vector<std::string>& keys,
                                                     const std::vector<std::string>& statistics) {
  std::map<std::string, TablePlot> plots;
  for (const std::string& x : keys) {
    if (x == "repeat" || numbers_in(table, x).size() < 2) continue;
    for (const std::string& y : statistics) {
      if (numbers_in(table, y).empty()) continue;
      TablePlot plot{x, y, {}, wide(numbers_in(table, x)), wide(numbers_in(table, y))};
      for (const std::string& other : keys)
        if (other != x && other != "repeat") plot.by.push_back(other);
      plots[file_name(y) + "_by_" + file_name(short_name(x))] = plot;
    }
  }
  return plots;
}

}  // namespace tack
