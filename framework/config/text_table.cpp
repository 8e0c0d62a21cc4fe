#include "framework/config/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "framework/config/read_file.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr size_t title_lines_max = 500;  // searched for the header

std::string_view stripped(std::string_view text) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

struct Line {
  int number = 0;
  std::string_view text;
};

// Returns the lines that are neither empty nor comments.
std::vector<Line> lines_of(const std::string& path, std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError(path + ": is written in UTF-16; store it as UTF-8 (\"CSV UTF-8\" of spreadsheets)");
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view inner = stripped(text.substr(0, end));
    if (inner.find_first_not_of(",;\t ") != inner.npos && inner.front() != '#') lines.push_back({number, text.substr(0, end)});
    text.remove_prefix(std::min(text.size(), end + (text.substr(end).starts_with("\r\n") ? 2 : 1)));
  }
  return lines;
}

char separator_of(std::string_view header) { return header.find(';') != header.npos ? ';' : header.find('\t') != header.npos ? '\t' : ','; }

// Returns nothing if a quote is not closed.
std::optional<std::vector<std::string>> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    else if (c == separator && !quoted) cells.emplace_back();
    else cells.back() += c;
  }
  if (quoted) return std::nullopt;
  for (std::string& cell : cells) cell = std::string(stripped(cell));
  return cells;
}

Heading heading_of(std::string_view cell) {
  const size_t open = cell.find_last_of("[(");
  const bool has_unit = open != cell.npos && open > 0 && (cell.back() == ']' || cell.back() == ')');
  if (!has_unit) return {std::string(stripped(cell)), ""};
  return {std::string(stripped(cell.substr(0, open))), std::string(stripped(cell.substr(open + 1, cell.size() - open - 2)))};
}

size_t count_names(const std::vector<std::string>& cells, const std::vector<std::string>& names) {
  return static_cast<size_t>(std::count_if(names.begin(), names.end(), [&](const std::string& name) {
    return std::any_of(cells.begin(), cells.end(), [&](const std::string& cell) { return same_name(heading_of(cell).name, name); });
  }));
}

bool begins_like_number(std::string_view cell) {
  if (cell.starts_with('-') || cell.starts_with('+')) cell.remove_prefix(1);
  return !cell.empty() && std::isdigit(static_cast<unsigned char>(cell.front())) != 0;
}

// Returns the line that seems to name the columns: the one above the first row of numbers, or above
// its row of units.
size_t line_above_numbers(const std::vector<Line>& lines) {
  const auto all = [&](size_t i, const auto& holds) {
    const auto cells = cells_of(lines[i].text, separator_of(lines[i].text));
    return cells && cells->size() > 1 && std::all_of(cells->begin(), cells->end(), holds);
  };
  const auto bracketed = [](const std::string& cell) { return cell.starts_with('(') || cell.starts_with('['); };
  for (size_t i = 1; i < std::min(lines.size(), title_lines_max); ++i)
    if (all(i, begins_like_number)) return all(i - 1, begins_like_number) ? 0 : i >= 2 && all(i - 1, bracketed) ? i - 2 : i - 1;
  return 0;
}

size_t header_among(const std::vector<Line>& lines, const std::vector<std::string>& names) {
  size_t best = line_above_numbers(lines), most = 0;
  for (size_t i = 0; i < std::min(lines.size(), title_lines_max) && most < names.size(); ++i) {
    const auto cells = cells_of(lines[i].text, separator_of(lines[i].text));
    const size_t found = cells ? count_names(*cells, names) : 0;
    if (found <= most) continue;
    best = i;
    most = found;
  }
  return best;
}

}  // namespace

bool same_name(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

TextTable read_text_table(const std::string& path, const std::vector<std::string>& names) {
  const std::string text = read_file(path, largest_text);
  const std::vector<Line> lines = lines_of(path, text);
  if (lines.empty()) throw InputError(path + ": is empty; a line has to name its columns");
  const size_t header = header_among(lines, names);
  TextTable table{lines[header].number, separator_of(lines[header].text), {}, {}};
  for (size_t i = header; i < lines.size(); ++i) {
    auto cells = cells_of(lines[i].text, table.separator);
    if (!cells) throw InputError(fmt::format("{}:{}: a quote is not closed; mend this line", path, lines[i].number));
    if (i > header) table.rows.push_back({lines[i].number, std::move(*cells)});
    else
      for (const std::string& cell : *cells) table.headings.push_back(heading_of(cell));
  }
  return table;
}

}  // namespace tack
