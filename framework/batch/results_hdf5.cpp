#include "framework/batch/results_hdf5.hpp"

#include <algorithm>
#include <charconv>
#include <deque>
#include <limits>
#include <optional>
#include <set>

#include "framework/batch/hdf5_library.hpp"

namespace tack {
namespace {

// Returns the texts as numbers, NaN for empty ones; none if a text is no number or all are empty.
std::optional<std::vector<double>> numbers_of(const std::vector<std::string>& texts) {
  std::vector<double> numbers(texts.size(), std::numeric_limits<double>::quiet_NaN());
  bool any = false;
  for (size_t i = 0; i < texts.size(); ++i) {
    const std::string& text = texts[i];
    if (text.empty()) continue;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), numbers[i]);
    if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
    any = true;
  }
  return any ? std::optional(std::move(numbers)) : std::nullopt;
}

// Returns the name of the dataset of a column, which no other one has.
std::string dataset_name(const std::string& column, std::set<std::string>& taken) {
  std::string name = column == "." ? "_" : column;
  std::replace(name.begin(), name.end(), '/', '_');
  while (!taken.insert(name).second) name += '_';
  return name;
}

}  // namespace

void write_results_hdf5(const std::filesystem::path& path, const ResultsTable& table, const BatchDescription& d) {
  std::deque<std::vector<double>> parsed;  // parameters that are numbers
  std::vector<Hdf5Column> columns;
  std::set<std::string> taken;
  for (const ResultsColumn& column : table.columns) {
    Hdf5Column out{dataset_name(column.name, taken), {{"name", column.name}, {"role", std::string(to_string(column.role))}}};
    if (column.is_number()) out.numbers = &column.numbers;
    else if (auto numbers = column.role == ColumnRole::parameter ? numbers_of(column.texts) : std::nullopt)
      out.numbers = &parsed.emplace_back(std::move(*numbers));
    else out.texts = &column.texts;
    const auto unit = d.plan.units.find(column.name);
    if (out.numbers) out.attributes.emplace_back("unit", unit == d.plan.units.end() ? "1" : unit->second);
    columns.push_back(std::move(out));
  }
  write_hdf5_table(path, {{"format", "tack batch"}, {"name", d.plan.name}, {"about", d.plan.about}, {"file", d.file}, {"provenance", d.provenance}}, columns);
}

}  // namespace tack
