// Tables of numbers with a header line, as .csv files (RFC 4180: a name with a comma or a quote is
// quoted). Numbers are written with the fewest digits that read back as the same bits; infinities
// and not-a-numbers as inf, -inf, nan. A text that spreadsheets would take for a formula ("=...", "+...", "-...", "@...") has an apostrophe
// before it in the file, and none once it is read.
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
  std::vector<std::vector<double>> rows;  // as many numbers each as there are columns

  std::optional<std::size_t> column(std::string_view name) const;
};

// The same with cells as they are written, without their quotes.
struct CsvTexts {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

// Text as a cell: quoted where it has to be.
std::string csv_cell(const std::string& text);

// Ignores a last line without its line end: what an interrupted run leaves. Throws InputError
// naming file and line for anything that is no such table.
CsvTable read_csv(const std::filesystem::path& path);
CsvTexts read_csv_texts(const std::filesystem::path& path);

// The cells of a line, without its end.
std::vector<std::string> csv_cells(std::string_view line);

// The number that is all of a text, in the form of the files; nothing for anything else.
std::optional<double> csv_number(std::string_view text);

// The rows whose column "time" is not above `last_time` [s]. Throws InputError without that
// column; `name` is what messages call the table.
CsvTable rows_until(CsvTable table, double last_time, const std::string& name);

// A table that grows by one row at a time and is complete on disk after each. Throws InputError
// naming the path when it cannot be written or two columns have one name.
class CsvFile {
 public:
  // Starts the file anew with the header and the rows of `start`.
  CsvFile(std::filesystem::path path, const CsvTable& start);

  // Whole numbers up to 2^53 are written as such. Throws std::logic_error for a wrong count.
  void add(std::span<const double> row);

 private:
  std::filesystem::path path_;
  std::size_t columns_;
  std::ofstream out_;
};

}  // namespace tack
