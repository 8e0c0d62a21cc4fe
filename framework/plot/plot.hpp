// A plot as data: curves or stacked bars over axes. gnuplot.hpp draws it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tack {

struct Curve {
  std::string title;
  std::vector<std::pair<double, double>> points;  // a point without an x breaks the line
  // Ranges of y, {low, high} per point, drawn as error bars; empty: none.
  std::vector<std::pair<double, double>> spread;
  // Marks without a line, whatever the style of the plot.
  bool scattered = false;
};

// A labelled line across the plot: horizontal in `levels`, vertical in `verticals`.
struct LevelLine {
  double at = 0;
  std::string title;
};

// A labelled range of x, shaded behind the curves.
struct Band {
  double low = 0, high = 0;
  std::string title;
};

struct Plot {
  std::string title, x_label, y_label;
  // SI units of the data; drawn with a suitable prefix.
  std::string x_unit = {}, y_unit = {};
  bool log_x = false, log_y = false;
  // Lines with points, lines alone, stairs.
  enum class Style { points, lines, steps } style = Style::points;
  std::vector<Curve> curves;
  std::vector<LevelLine> levels;
  std::vector<LevelLine> verticals = {};
  std::vector<Band> bands = {};
  std::vector<std::string> notes;  // below the plot: omitted data and the reason
};

// A line across a bar, at a height that something else has.
struct BarMark {
  size_t bar;
  double height;
  std::string title;
};

// One bar for each of `names`, stacked from `segments`.
struct StackedBars {
  std::string title, y_label;
  std::vector<std::string> names;            // of the bars
  std::vector<std::string> segments;         // from the bottom up
  std::vector<std::vector<double>> heights;  // heights[bar][segment]
  std::optional<double> top;                 // end of the axis, if prescribed
  // SI unit of the heights; drawn with a suitable prefix.
  std::string y_unit = {};
  std::vector<BarMark> marks = {};
};

// Returns the plot restricted to x in [low, high]. A curve that leaves the range is broken there.
Plot within(Plot plot, double low, double high);

// Merges curves with equal points into one with both titles; otherwise one would hide the other.
std::vector<Curve> merged_curves(const std::vector<Curve>& curves);

// Range of an axis. position(): position of a value, 0 at the lower end and 1 at the upper.
struct AxisRange {
  double low = 0, high = 1;
  bool log = false;
  double position(double value) const;
};

// Returns the range of the data with a margin of a twentieth, not rounded to decades. Numbers
// without a logarithm are left out; returns nothing if none remain.
std::optional<AxisRange> range_of(const std::vector<double>& numbers, bool log);

// Returns the ticks of a logarithmic axis:
// - two decades or more: the decades
// - fewer: 1, 2 and 5 of each decade
// - much less than one decade: as on a linear axis
std::vector<double> log_ticks(const AxisRange& range);

// Returns heights in [0, 1] for labels, close to `wanted` and at least `apart` from each other;
// nothing if they do not fit.
std::optional<std::vector<double>> separate_labels(const std::vector<double>& wanted, double apart);

}  // namespace tack
