// Tables of numbers with a header line as .csv files (RFC 4180: names with commas or quotes are
// quoted). Cells:
//    numbers                       fewest digits that read back as the same bits
//    infinity, not a number        inf, -inf, nan
//    texts like formulas           ("=...", "+...", "-...", "@...") with an apostrophe in front,
//                                  for spreadsheets; readers remove it
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tack {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  // one number per column

  std::optional<std::size_t> column(std::string_view name) const;
};

// A table with its cells as texts, without their quotes.
struct CsvTexts {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

// Returns a text as a cell, quoted if necessary.
std::string csv_cell(const std::string& text);

// Reads a table. Skips a last line without line end, which an interrupted run leaves. Throws
// InputError with file and line for a malformed table.
CsvTable read_csv(const std::filesystem::path& path);
CsvTexts read_csv_texts(const std::filesystem::path& path);

// Returns the cells of a line, without its line end.
std::vector<std::string> csv_cells(std::string_view line);

// Returns the number that a whole text is, in the format of the files; nothing otherwise.
std::optional<double> csv_number(std::string_view text);

// Returns the rows whose column "time" is not above `last_time` [s]. name: of the table, for
// messages. Throws InputError without that column.
CsvTable rows_until(CsvTable table, double last_time, const std::string& name);

// A table that grows row by row and is complete on disk after each row. Throws InputError with the
// path if it cannot be written or two columns have one name.
class CsvFile {
 public:
  // Replaces the file by the header and the rows of `start`.
  CsvFile(std::filesystem::path path, const CsvTable& start);

  // Appends a row; whole numbers up to 2^53 are written as such. Throws std::logic_error for a
  // wrong count.
  void add(std::span<const double> row);

 private:
  std::filesystem::path path_;
  std::size_t columns_;
  std::ofstream out_;
};

}  // namespace tack
