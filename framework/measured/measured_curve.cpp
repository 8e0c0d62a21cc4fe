#include "framework/measured/measured_curve.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"

namespace tack {

std::string MeasuredCurve::location(size_t point) const { return fmt::format("{}:{}", path, lines.at(point)); }

MeasuredCurve read_curve(const std::string& path, const QuantityColumn& x, const QuantityColumn& y) {
  QuantityTable table = read_quantities(path, {x, y});
  if (table.rows() == 0) throw InputError(path + ": has no row of numbers; a measured curve needs at least one point");
  return {path, std::move(table.columns[0]), std::move(table.columns[1]), std::move(table.lines)};
}

MeasuredCurve points_within(const MeasuredCurve& curve, double from, double to) {
  MeasuredCurve selected{curve.path, {}, {}, {}};
  for (size_t i = 0; i < curve.size(); ++i) {
    if (curve.x[i] < from || curve.x[i] > to) continue;
    selected.x.push_back(curve.x[i]);
    selected.y.push_back(curve.y[i]);
    selected.lines.push_back(curve.lines[i]);
  }
  return selected;
}

}  // namespace tack
