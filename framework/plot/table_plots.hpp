// Pictures of the table of a batch: a number of each case over one that varies, a curve for each choice of the others.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framework/plot/plot.hpp"

namespace tack {

// A table of texts; those that are numbers are read as such.
struct TextTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  // Throws InputError with the nearest name.
  std::size_t column(const std::string& name) const;
};

// Throws InputError for what is no such table.
TextTable read_text_table(const std::filesystem::path& path);

struct TablePlot {
  std::string x, y;
  std::vector<std::string> by;  // a curve for each combination of these
  bool log_x = false, log_y = false;
};

// Cases with equal x of one curve are repeats: their mean is drawn, with a bar from the least to the largest. Rows without a number at x or y
// are named in a note.
Plot table_plot(const TextTable& table, const TablePlot& what);

// For each of `keys` that has at least two numbers and each of `statistics`: what it depends on, by the other keys. By the names of pictures.
std::map<std::string, TablePlot> default_table_plots(const TextTable& table, const std::vector<std::string>& keys,
                                                     const std::vector<std::string>& statistics);

}  // namespace tack
