// Columns of numbers with units, from a file that a measurement or a spreadsheet left: names in its first line, each with its unit
// ("gap [um], traction [kPa]"; without one, SI), or the units in a line of their own below. Commas, semicolons or tabs part cells; line ends of any
// system, a byte order mark, quotes, empty lines and lines that begin with # may be there, and columns that nobody asks for.
#pragma once

#include <string>
#include <vector>

#include "framework/config/units.hpp"

namespace tack {

struct QuantityColumn {
  std::string name;  // in the file; upper and lower case are the same
  Unit unit;
  std::string key;   // of the scene file, by which another name is chosen: for messages
};

struct QuantityTable {
  std::string path;
  std::vector<std::vector<double>> columns;  // as they were asked for, in SI
  std::vector<int> lines;                    // of the file, of each row

  size_t rows() const { return lines.size(); }
  std::string place(size_t row) const;  // "data.csv:7: "
};

// Throws InputError with file and line for a column that is not there, a unit of another dimension, a line that lacks cells, what is no
// finite number, and a file that cannot be read.
QuantityTable read_quantities(const std::string& path, const std::vector<QuantityColumn>& wanted);

}  // namespace tack
