#include "framework/config/quantity_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "framework/config/text_table.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

std::optional<double> number_in(std::string_view cell) {
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  double number = 0;
  const char* end = cell.data() + cell.size();
  const auto [stop, status] = std::from_chars(cell.data(), end, number);
  if (cell.empty() || status != std::errc() || stop != end) return std::nullopt;
  return number;
}

// Returns true for "0,5" or "-1,25e-3": a number but for its comma.
bool has_decimal_comma(std::string cell) {
  const size_t comma = cell.find(',');
  if (comma == cell.npos || cell.find_first_of(",.", comma + 1) != cell.npos || cell.find('.') < comma) return false;
  cell[comma] = '.';
  return number_in(cell).has_value();
}

// Returns true for "1,250" and "-12,500", which may be a thousand and more, or one and more.
bool may_group_thousands(std::string_view cell) {
  if (cell.starts_with('+') || cell.starts_with('-')) cell.remove_prefix(1);
  const size_t comma = cell.find(',');
  return comma >= 1 && comma <= 3 && cell.front() != '0' && cell.size() == comma + 4 && cell.find_first_not_of("0123456789,") == cell.npos;
}

size_t column_of(const QuantityColumn& wanted, const std::vector<Heading>& headings, const std::string& location) {
  std::vector<std::string> names;
  size_t found = headings.size();
  for (size_t i = 0; i < headings.size(); ++i) {
    names.push_back(headings[i].name);
    if (!same_name(headings[i].name, wanted.name)) continue;
    if (found < headings.size()) throw InputError(fmt::format("{}two columns are called '{}'; rename one of them", location, wanted.name));
    found = i;
  }
  if (found < headings.size()) return found;
  if (std::all_of(names.begin(), names.end(), [](const std::string& name) { return number_in(name).has_value(); }))
    throw InputError(fmt::format("{}no line above names the columns; add one, with their units: \"{} [{}]\", say, for one of them", location, wanted.name, wanted.unit.si));
  throw InputError(fmt::format("{}there is no column '{}' among '{}'; rename one, or say which one it is by {}", location, wanted.name,
                               fmt::join(names, "', '"), wanted.key));
}

double factor_of(const std::string& unit, const QuantityColumn& wanted, const std::string& location) {
  if (unit.empty()) return 1;
  try {
    return to_si("1 " + unit, wanted.unit);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}column '{}': {}", location, wanted.name, error.what()));
  }
}

std::string bare_unit(std::string_view cell) {
  if (cell.size() > 1 && (cell.front() == '[' || cell.front() == '(')) cell = cell.substr(1, cell.size() - 2);
  return std::string(cell);
}

// Reads the wanted columns of a table.
class Columns {
 public:
  Columns(const std::string& path, const std::vector<QuantityColumn>& wanted, const TextTable& table) : path_(path), wanted_(wanted), table_(table) {
    for (const QuantityColumn& column : wanted) {
      at_.push_back(column_of(column, table.headings, location(table.header_line)));
      const std::string& unit = table.headings[at_.back()].unit;
      factors_.push_back(factor_of(unit, column, location(table.header_line)));
      has_units_ = has_units_ || !unit.empty();
    }
  }

  QuantityTable read() {
    for (const TextTable::Row& row : table_.rows) check_width(row);
    size_t first = 0;
    if (!table_.rows.empty() && !has_units_ && is_row_of_units(table_.rows[0])) {
      for (size_t k = 0; k < at_.size(); ++k) factors_[k] = factor_of(bare_unit(table_.rows[0].cells[at_[k]]), wanted_[k], location(table_.rows[0].line));
      first = 1;
    }
    find_decimal_commas(first);
    QuantityTable numbers{path_, std::vector<std::vector<double>>(at_.size()), {}};
    for (size_t i = first; i < table_.rows.size(); ++i) {
      for (size_t k = 0; k < at_.size(); ++k) numbers.columns[k].push_back(number(table_.rows[i], k));
      numbers.lines.push_back(table_.rows[i].line);
    }
    return numbers;
  }

 private:
  std::string location(int line) const { return fmt::format("{}:{}: ", path_, line); }

  // Throws unless a row has a cell for each heading, and no text beyond.
  void check_width(const TextTable::Row& row) const {
    const size_t width = table_.headings.size();
    if (row.cells.size() >= width && std::all_of(row.cells.begin() + static_cast<long>(width), row.cells.end(), [](const std::string& cell) { return cell.empty(); })) return;
    const bool commas = table_.separator == ',' && row.cells.size() == 2 * width;
    throw InputError(fmt::format("{}{} cells, where line {} names {}; {}", location(row.line), row.cells.size(), table_.header_line, width,
                                 commas ? "if its commas are decimal ones, separate columns by semicolons or tabs" : "mend or remove this line"));
  }

  // Returns true if a row has texts, not numbers, in the wanted columns.
  bool is_row_of_units(const TextTable::Row& row) const {
    const auto is_number = [&](size_t i) { return number_in(row.cells[i]).has_value() || has_decimal_comma(row.cells[i]); };
    return std::none_of(at_.begin(), at_.end(), is_number) && std::any_of(at_.begin(), at_.end(), [&](size_t i) { return !row.cells[i].empty(); });
  }

  // Commas are decimal if no number of the columns has a point, and at least one cannot be thousands in groups.
  void find_decimal_commas(size_t first) {
    bool points = false;
    for (size_t i = first; i < table_.rows.size(); ++i)
      for (const size_t k : at_) {
        const std::string& cell = table_.rows[i].cells[k];
        points = points || (cell.find('.') != cell.npos && number_in(cell).has_value());
        decimal_commas_ = decimal_commas_ || (has_decimal_comma(cell) && !may_group_thousands(cell));
      }
    decimal_commas_ = decimal_commas_ && !points;
  }

  double number(const TextTable::Row& row, size_t k) const {
    std::string cell = row.cells[at_[k]];
    const bool comma = has_decimal_comma(cell);
    if (comma && decimal_commas_) cell[cell.find(',')] = '.';
    const auto number = number_in(cell);
    if (number && std::isfinite(factors_[k] * *number)) return factors_[k] * *number;
    const std::string why = number                        ? "is not finite; mend or remove this line"
                            : cell.empty()                ? "is empty; mend or remove this line"
                            : may_group_thousands(cell)   ? "may have a decimal comma or a group of thousands; write numbers with a point and without groups"
                            : comma                       ? "has a comma, and other numbers have a point; write all numbers with a point"
                                                          : "is no number; mend or remove this line";
    throw InputError(fmt::format("{}{} '{}' {}", location(row.line), wanted_[k].name, cell, why));
  }

  const std::string& path_;
  const std::vector<QuantityColumn>& wanted_;
  const TextTable& table_;
  std::vector<size_t> at_;  // column of each wanted one
  std::vector<double> factors_;
  bool has_units_ = false, decimal_commas_ = false;
};

}  // namespace

std::string QuantityTable::location(size_t row) const { return fmt::format("{}:{}: ", path, lines.at(row)); }

QuantityTable read_quantities(const std::string& path, const std::vector<QuantityColumn>& wanted) {
  std::vector<std::string> names;
  for (const QuantityColumn& column : wanted) names.push_back(column.name);
  const TextTable table = read_text_table(path, names);
  return Columns(path, wanted, table).read();
}

}  // namespace tack
