// A curve as it was measured: numbers over numbers, in the order of the file, which for what is loaded and unloaded is the order in time.
#pragma once

#include <string>
#include <vector>

#include "framework/config/quantity_table.hpp"

namespace tack {

struct MeasuredCurve {
  std::string path;
  std::vector<double> x, y;  // SI
  std::vector<int> lines;    // of the file, of each point

  size_t size() const { return x.size(); }
  std::string place(size_t point) const;  // "load.csv:7"
};

// Throws InputError with file and line as read_quantities does, also for a file without a point.
MeasuredCurve read_curve(const std::string& path, const QuantityColumn& x, const QuantityColumn& y);

// The points with from <= x <= to.
MeasuredCurve part_of(const MeasuredCurve& curve, double from, double to);

}  // namespace tack
