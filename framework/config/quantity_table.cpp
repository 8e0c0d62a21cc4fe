#include "framework/config/quantity_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "framework/config/read_file.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

std::string_view stripped(std::string_view text) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::optional<double> number_in(std::string_view cell) {
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  double number = 0;
  const char* end = cell.data() + cell.size();
  const auto [stop, status] = std::from_chars(cell.data(), end, number);
  if (cell.empty() || status != std::errc() || stop != end) return std::nullopt;
  return number;
}

struct Line {
  int number = 0;
  std::vector<std::string> cells;
};

// Name and unit in a heading: "gap [um]", "gap (um)", "gap".
struct Heading {
  std::string name, unit;

  explicit Heading(std::string_view cell) {
    const size_t open = cell.find_last_of("[(");
    const bool has_unit = open != cell.npos && open > 0 && !cell.empty() && (cell.back() == ']' || cell.back() == ')');
    name = stripped(cell.substr(0, has_unit ? open : cell.npos));
    if (has_unit) unit = stripped(cell.substr(open + 1, cell.size() - open - 2));
  }
};

class Lines {
 public:
  Lines(const std::string& path, std::string_view text) : path_(path), rest_(text) {
    if (rest_.starts_with("\xff\xfe") || rest_.starts_with("\xfe\xff"))
      throw InputError(path + ": is written in UTF-16; store it as UTF-8 (\"CSV UTF-8\" of spreadsheets)");
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  }

  // Reads the next line that is not empty. Returns false at the end.
  bool next(Line& line) {
    while (!rest_.empty()) {
      const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
      const std::string_view text = rest_.substr(0, end);
      rest_.remove_prefix(std::min(rest_.size(), end + (rest_.substr(end).starts_with("\r\n") ? 2 : 1)));
      line.number = ++number_;
      const std::string_view inner = stripped(text);
      if (inner.find_first_not_of(",;\t ") == inner.npos || inner.front() == '#') continue;
      if (separator_ == 0) separator_ = text.find(';') != text.npos ? ';' : text.find('\t') != text.npos ? '\t' : ',';
      split(text, line);
      return true;
    }
    return false;
  }

 private:
  void split(std::string_view text, Line& line) {
    line.cells.assign(1, "");
    bool quoted = false;
    for (const char c : text) {
      if (c == '"') quoted = !quoted;
      else if (c == separator_ && !quoted) line.cells.emplace_back();
      else line.cells.back() += c;
    }
    if (quoted) throw InputError(fmt::format("{}:{}: a quote is not closed; mend this line", path_, line.number));
    for (std::string& cell : line.cells) cell = std::string(stripped(cell));
  }

  const std::string& path_;
  std::string_view rest_;
  int number_ = 0;
  char separator_ = 0;
};

size_t column_of(const QuantityColumn& wanted, const std::vector<Heading>& headings, const std::string& location) {
  std::vector<std::string> names;
  size_t found = headings.size();
  for (size_t i = 0; i < headings.size(); ++i) {
    names.push_back(headings[i].name);
    if (lower_case(headings[i].name) != lower_case(wanted.name)) continue;
    if (found < headings.size()) throw InputError(fmt::format("{}two columns are called '{}'; rename one of them", location, wanted.name));
    found = i;
  }
  if (found < headings.size()) return found;
  if (std::all_of(names.begin(), names.end(), [](const std::string& name) { return number_in(name).has_value(); }))
    throw InputError(fmt::format("{}the first line has to name the columns, with their units: \"{} [{}]\", say, for one of them", location, wanted.name, wanted.unit.si));
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

double read_number(const std::string& cell, double factor, const QuantityColumn& wanted, const std::string& location) {
  const auto number = number_in(cell);
  if (number && std::isfinite(factor * *number)) return factor * *number;
  const bool comma = !number && cell.find(',') != cell.npos && cell.find_first_not_of("+-0123456789,.eE") == cell.npos;
  const std::string why = number ? "is not finite" : cell.empty() ? "is empty" : comma ? "has a comma; write numbers with a point" : "is no number";
  throw InputError(fmt::format("{}{} '{}' {}; mend or remove this line", location, wanted.name, cell, why));
}

// Returns true for a line with at least as many cells as the first line and no text beyond them.
bool fits(const Line& line, size_t width) {
  return line.cells.size() >= width && std::all_of(line.cells.begin() + width, line.cells.end(), [](const std::string& cell) { return cell.empty(); });
}

// Returns true if a line has texts, not numbers, in the wanted columns.
bool holds_units(const Line& line, const std::vector<size_t>& at) {
  const auto number = [&](size_t i) { return number_in(line.cells[i]).has_value(); };
  return std::none_of(at.begin(), at.end(), number) && std::any_of(at.begin(), at.end(), [&](size_t i) { return !line.cells[i].empty(); });
}

std::string bare_unit(std::string_view cell) {
  if (cell.size() > 1 && (cell.front() == '[' || cell.front() == '(')) cell = stripped(cell.substr(1, cell.size() - 2));
  return std::string(cell);
}

}  // namespace

std::string QuantityTable::location(size_t row) const { return fmt::format("{}:{}: ", path, lines.at(row)); }

QuantityTable read_quantities(const std::string& path, const std::vector<QuantityColumn>& wanted) {
  const std::string text = read_file(path, largest_text);
  QuantityTable table{path, std::vector<std::vector<double>>(wanted.size()), {}};
  Lines lines(path, text);
  Line line;
  if (!lines.next(line)) throw InputError(path + ": is empty; its first line has to name the columns");
  const auto location = [&] { return fmt::format("{}:{}: ", path, line.number); };
  const size_t width = line.cells.size();
  const std::vector<Heading> headings(line.cells.begin(), line.cells.end());
  std::vector<size_t> at;
  std::vector<double> factors;
  bool units = false;
  for (const QuantityColumn& column : wanted) {
    at.push_back(column_of(column, headings, location()));
    factors.push_back(factor_of(headings[at.back()].unit, column, location()));
    units = units || !headings[at.back()].unit.empty();
  }
  for (bool first = true; lines.next(line); first = false) {
    if (!fits(line, width))
      throw InputError(fmt::format("{}{} cells, where the first line names {}; mend or remove this line", location(), line.cells.size(), width));
    const auto cell = [&](size_t k) { return line.cells[at[k]]; };
    if (first && !units && holds_units(line, at)) {
      for (size_t k = 0; k < at.size(); ++k) factors[k] = factor_of(bare_unit(cell(k)), wanted[k], location());
      continue;
    }
    for (size_t k = 0; k < at.size(); ++k) table.columns[k].push_back(read_number(cell(k), factors[k], wanted[k], location()));
    table.lines.push_back(line.number);
  }
  return table;
}

}  // namespace tack
