// Pictures of the table of a batch: a number of each case over one that varies, a curve for each choice of the others.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/output/csv.hpp"
#include "framework/plot/plot.hpp"

namespace tack {

struct TablePlot {
  std::string x, y;
  std::vector<std::string> by;  // a curve for each combination of these
  bool log_x = false, log_y = false;
};

// Cases with equal x of one curve are repeats: their mean is drawn, with a bar from the least to the largest. Rows without a number at x or y
// are named in a note.
// `units`: of columns that have one. Throws InputError, with the nearest name, for a column that is not there.
Plot table_plot(const CsvTexts& table, const TablePlot& what, const std::map<std::string, std::string>& units = {});

// For each of `keys` that has at least two numbers and each of `statistics`: what it depends on, by the other keys. By the names of pictures.
std::map<std::string, TablePlot> default_table_plots(const CsvTexts& table, const std::vector<std::string>& keys,
                                                     const std::vector<std::string>& statistics);

}  // namespace tack
