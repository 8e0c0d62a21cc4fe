#include "framework/output/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <stdexcept>

#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

std::string header(const std::vector<std::string>& columns) {
  std::string line;
  for (const std::string& name : columns) line += (line.empty() ? "" : ",") + csv_cell(name);
  return line + "\n";
}

std::string row_text(std::span<const double> row) {
  return fmt::format("{}\n", fmt::join(row, ","));
}

void refuse_duplicates(const fs::path& path, std::vector<std::string> columns) {
  std::sort(columns.begin(), columns.end());
  const auto twice = std::adjacent_find(columns.begin(), columns.end());
  if (twice == columns.end()) return;
  throw InputError(
      fmt::format("{}: two columns are named '{}'; rename one of them", path.string(), *twice));
}

// Returns true for a text that spreadsheets would read as a formula, with or without apostrophes in
// front.
bool formula(std::string_view text) {
  const std::size_t begin = text.find_first_not_of('\'');
  return begin != text.npos && std::string_view("=+-@\t").find(text[begin]) != std::string_view::npos;
}

// Calls act(cells, where) for the header and each row.
template <class Act>
void for_each_line(const fs::path& path, const Act& act) {
  std::ifstream in(path, std::ios::binary);
  if (!in || fs::is_directory(path)) {
    throw InputError(fmt::format("{}: cannot read this file", path.string()));
  }
  std::string line;
  std::size_t columns = 0;
  for (int number = 1; std::getline(in, line) && !in.eof(); ++number) {
    const std::string where = fmt::format("{}:{}", path.string(), number);
    // a cell of several lines
    for (std::string more; std::count(line.begin(), line.end(), '"') % 2 == 1; ++number) {
      if (!std::getline(in, more) || in.eof()) return;
      line += "\n" + more;
    }
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> cells = csv_cells(line);
    if (columns == 0) columns = cells.size();
    if (cells.size() != columns) {
      throw InputError(
          fmt::format("{}: {} cells, but the header names {} columns; correct or remove "
                      "this line",
                      where, cells.size(), columns));
    }
    act(std::move(cells), where);
  }
  if (columns == 0) throw InputError(fmt::format("{}: has no header line", path.string()));
}

std::vector<double> numbers(const std::vector<std::string>& cells, const std::string& where) {
  std::vector<double> row;
  for (const std::string& cell : cells) {
    const auto number = csv_number(cell);
    if (!number) throw InputError(fmt::format("{}: '{}' is not a number; correct or remove this line", where, cell));
    row.push_back(*number);
  }
  return row;
}

}  // namespace

std::vector<std::string> csv_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool pair = inside && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (pair) {
      cells.back() += line[i++];
    } else if (line[i] == '"') {
      inside = !inside;
    } else if (line[i] == ',' && !inside) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  for (std::string& cell : cells)
    if (cell.starts_with('\'') && formula(cell)) cell.erase(0, 1);
  return cells;
}

std::string csv_cell(const std::string& given) {
  std::string text = (formula(given) && !csv_number(given) ? "'" : "") + given;
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::optional<double> csv_number(std::string_view text) {
  double number = 0;
  const char* end = text.data() + text.size();
  if (text.empty() || std::from_chars(text.data(), end, number).ptr != end) return std::nullopt;
  return number;
}

CsvTable read_csv(const fs::path& path) {
  CsvTable table;
  for_each_line(path, [&](std::vector<std::string> cells, const std::string& where) {
    if (table.columns.empty()) table.columns = std::move(cells);
    else table.rows.push_back(numbers(cells, where));
  });
  return table;
}

CsvTexts read_csv_texts(const fs::path& path) {
  CsvTexts table;
  for_each_line(path, [&](std::vector<std::string> cells, const std::string&) {
    if (table.columns.empty()) table.columns = std::move(cells);
    else table.rows.push_back(std::move(cells));
  });
  return table;
}

CsvTable rows_until(CsvTable table, double last_time, const std::string& name) {
  const auto time = table.column("time");
  if (!time) throw InputError(name + ": a table without a column 'time' cannot be continued; start again");
  std::erase_if(table.rows, [&](const auto& row) { return !(row[*time] <= last_time); });
  return table;
}

CsvFile::CsvFile(fs::path path, const CsvTable& start)
    : path_(std::move(path)), columns_(start.columns.size()) {
  refuse_duplicates(path_, start.columns);
  std::string text = header(start.columns);
  for (const std::vector<double>& row : start.rows) text += row_text(row);
  replace_file(path_, text);
  errno = 0;
  out_.open(path_, std::ios::binary | std::ios::app);
  if (!out_) throw InputError(write_failure(path_));
}

void CsvFile::add(std::span<const double> row) {
  if (row.size() != columns_) {
    throw std::logic_error(fmt::format("{}: a row of {} numbers in a table of {} columns",
                                       path_.string(), row.size(), columns_));
  }
  errno = 0;
  out_ << row_text(row) << std::flush;
  if (!out_) throw InputError(write_failure(path_));
}

}  // namespace tack
