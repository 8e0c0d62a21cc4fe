// A picture as data: curves or stacked bars over axes. Drawn by gnuplot.hpp.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tack {

struct Curve {
  std::string title;
  std::vector<std::pair<double, double>> points;
  std::vector<std::pair<double, double>> spread;  // of y, {low, high} per point, drawn as bars; empty: none
  bool scattered = false;                         // marks without a line, whatever the picture's style
};

// A line across the picture at a height, with its name beside it; or upright, at an abscissa.
struct LevelLine {
  double at = 0;
  std::string title;
};

struct Plot {
  std::string title, x_label, y_label;
  std::string x_unit = {}, y_unit = {};  // SI, of the numbers below; drawn with the prefix that suits them
  bool log_x = false, log_y = false;
  enum class Style { points, lines, steps } style = Style::points;  // lines with points, lines alone, stairs
  std::vector<Curve> curves;
  std::vector<LevelLine> levels;
  std::vector<LevelLine> uprights = {};
  std::vector<std::string> notes;  // below the picture: what it does not show, and why
};

// For each of `names` a bar of parts, one on the other.
struct StackedBars {
  std::string title, y_label;
  std::vector<std::string> names;                      // of the bars
  std::vector<std::string> parts;                      // from the foot up
  std::vector<std::vector<double>> heights;            // heights[bar][part]
  std::optional<double> top;                           // of the axis, if it has to end there
  std::string y_unit = {};                             // SI, of the heights; drawn with the prefix that suits them
};

// A text as part of a file's name.
std::string picture_name(std::string text);

// What lies from `low` to `high` along x.
Plot within(Plot plot, double low, double high);

// Curves whose points are the same are one, with both titles: else the one would hide the other.
std::vector<Curve> merged_curves(const std::vector<Curve>& curves);

// A place on the axis, 0 at its lower end and 1 at its upper.
struct AxisRange {
  double low = 0, high = 1;
  bool log = false;
  double place(double value) const;
};

// The range of numbers that are drawn, with a margin of a twentieth of it: no whole decades. Numbers that a logarithm has no place for are
// left out; nothing if there are none.
std::optional<AxisRange> range_of(const std::vector<double>& numbers, bool log);

// Of a logarithmic axis: the decades; with fewer than two of them 1, 2 and 5 of each; with much less than one as on a linear axis.
std::vector<double> log_ticks(const AxisRange& range);

// Heights from 0 to 1 for labels that want to stand at `wanted`, no nearer to each other than `apart`; nothing if there is no room.
std::optional<std::vector<double>> spread_out(const std::vector<double>& wanted, double apart);

}  // namespace tack
