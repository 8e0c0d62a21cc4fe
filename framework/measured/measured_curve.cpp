#include "framework/measured/measured_curve.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"

namespace tack {

std::string MeasuredCurve::place(size_t point) const { return fmt::format("{}:{}", path, lines.at(point)); }

MeasuredCurve read_curve(const std::string& path, const QuantityColumn& x, const QuantityColumn& y) {
  QuantityTable table = read_quantities(path, {x, y});
  if (table.rows() == 0) throw InputError(path + ": has no row of numbers; a measured curve needs at least one point");
  return {path, std::move(table.columns[0]), std::move(table.columns[1]), std::move(table.lines)};
}

MeasuredCurve part_of(const MeasuredCurve& curve, double from, double to) {
  MeasuredCurve part{curve.path, {}, {}, {}};
  for (size_t i = 0; i < curve.size(); ++i) {
    if (curve.x[i] < from || curve.x[i] > to) continue;
    part.x.push_back(curve.x[i]);
    part.y.push_back(curve.y[i]);
    part.lines.push_back(curve.lines[i]);
  }
  return part;
}

}  // namespace tack
