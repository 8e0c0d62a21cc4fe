// Columns of numbers with units from a text file, such as measured data or a spreadsheet export:
//    first line    names, each with its unit ("gap [um], traction [kPa]"; without one: SI)
//    second line   optionally the units instead
//    cells         separated by commas, semicolons or tabs
// Allowed: any line ends, a byte order mark, quotes, empty lines, lines that begin with #, and
// columns that are not read.
#pragma once

#include <string>
#include <vector>

#include "framework/config/units.hpp"

namespace tack {

struct QuantityColumn {
  std::string name;  // in the file, case-insensitive
  Unit unit;
  std::string key;  // scene key that chooses another name, for messages
};

struct QuantityTable {
  std::string path;
  std::vector<std::vector<double>> columns;  // in the order requested, in SI
  std::vector<int> lines;                    // line in the file, per row

  size_t rows() const { return lines.size(); }
  std::string location(size_t row) const;  // "data.csv:7: "
};

// Reads the wanted columns. Throws InputError with file and line for a missing column, a unit of
// another dimension, a line with missing cells, a cell that is no finite number, and a file that
// cannot be read.
QuantityTable read_quantities(const std::string& path, const std::vector<QuantityColumn>& wanted);

}  // namespace tack
