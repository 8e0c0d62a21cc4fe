// A measured curve: points in the order of the file, which is the order in time for loading and
// unloading.
#pragma once

#include <string>
#include <vector>

#include "framework/config/quantity_table.hpp"

namespace tack {

struct MeasuredCurve {
  std::string path;
  std::vector<double> x, y;  // SI
  std::vector<int> lines;    // line of the file for each point

  size_t size() const { return x.size(); }
  std::string location(size_t point) const;  // source location: "load.csv:7"
};

// Reads a curve. Throws InputError with file and line as read_quantities does, also for a file
// without points.
MeasuredCurve read_curve(const std::string& path, const QuantityColumn& x, const QuantityColumn& y);

// Returns the points with from <= x <= to.
MeasuredCurve points_within(const MeasuredCurve& curve, double from, double to);

}  // namespace tack
