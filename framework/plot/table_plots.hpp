// Plots of the table of a batch: a number of each case over a varied one, with a curve for each
// combination of the other varied columns.
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

// Plots a table. Cases of one curve with equal x are repeats: their mean is drawn, with a bar from
// the smallest to the largest. Rows without a number at x or y are named in a note. `units`: by
// column. Throws InputError, with the nearest name, for an unknown column.
Plot table_plot(const CsvTexts& table, const TablePlot& what,
                const std::map<std::string, std::string>& units = {});

// Returns plots of each of `statistics` over each of `keys` with at least two numbers, with curves
// by the other keys; by the names of the pictures.
std::map<std::string, TablePlot> default_table_plots(const CsvTexts& table,
                                                     const std::vector<std::string>& keys,
                                                     const std::vector<std::string>& statistics);

}  // namespace tack
