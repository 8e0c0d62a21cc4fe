// Cells of a text file in columns, as spreadsheets, testing machines and digitisers write it: title
// lines, a line that names the columns, rows.
//
// The header is the first line with all the names that are asked for; what is above it is titles.
// Cells are separated by semicolons if the header has one, else by tabs if it has one, else by
// commas. Any line ends, a byte order mark, quotes, empty lines, and lines that begin with #.
#pragma once

#include <string>
#include <vector>

namespace tack {

// The name and the unit in a cell of a header: "gap [um]", "gap (um)", "gap".
struct Heading {
  std::string name, unit;  // unit: "" if there is none
};

struct TextTable {
  struct Row {
    int line = 0;  // in the file
    std::vector<std::string> cells;
  };

  int header_line = 0;
  char separator = ',';
  std::vector<Heading> headings;
  std::vector<Row> rows;  // below the header
};

// Reads a table with columns of these names, case-insensitive. If no line has all of them, the
// header is that with most of them, else the first line. Throws InputError with file and line for
// an empty file, one in UTF-16, a quote that is not closed at or below the header, and a file that
// cannot be read.
TextTable read_text_table(const std::string& path, const std::vector<std::string>& names);

// Returns true if both texts are the same but for the case of ASCII letters.
bool same_name(const std::string& a, const std::string& b);

}  // namespace tack
