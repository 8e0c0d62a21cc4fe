// Columns of numbers with units from a text file, such as measured data or a spreadsheet export:
//    title lines   above the line that names the columns; not read
//    names         each with its unit ("gap [um], traction [kPa]"; without one: SI)
//    units         optionally in a line below the names instead
//    rows          cells separated by semicolons, tabs or commas
// Decimal commas are read if they are unambiguous: no number of the columns has a point, and some
// number cannot have thousands in groups ("0,5", "12,25"). What else is allowed: text_table.hpp.
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
