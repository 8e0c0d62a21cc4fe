#include "framework/measured/measured_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "geometry/errors.hpp"

namespace tack {

void MeasuredData::fields(Fields& f) {
  f.path("file", file, "text in columns (CSV) with a line of names and units, `opening [mm], load [N]`; lines above it are titles; relative to the file that names it").required();
  f.text("x_column", x_column, "column of its abscissa; as the run's `along` unless given").line();
  f.text("y_column", y_column, "column of its measured values; as the run's `probe` unless given").line();
  f.optional_quantity("from", from, "smallest abscissa that counts; the file's unless given");
  f.optional_quantity("to", to, "largest abscissa that counts; the file's unless given");
  f.choice("relative_to", scale,
           {{"point", DeviationScale::point, "the magnitude of each point"},
            {"peak", DeviationScale::peak, "the largest magnitude of the points that count, for curves that pass through zero"}},
           "reference of relative deviations");
  f.check("from", [this]() -> std::string { return from && to && *from > *to ? "is above to" : ""; });
}

MeasuredCurve MeasuredData::read(const std::string& x, const Unit& x_unit, const std::string& y, const Unit& y_unit) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const QuantityColumn x_wanted{x_column.empty() ? x : x_column, x_unit, "x_column"}, y_wanted{y_column.empty() ? y : y_column, y_unit, "y_column"};
  const MeasuredCurve all = read_curve(file, x_wanted, y_wanted);
  MeasuredCurve selected = points_within(all, from ? from->si : -infinity, to ? to->si : infinity);
  if (selected.size() > 0) return selected;
  const auto [low, high] = std::minmax_element(all.x.begin(), all.x.end());
  throw InputError(fmt::format("{}: no point lies between from and to; its {} goes from {:.6g} to {:.6g}", file, x_wanted.name, *low, *high));
}

}  // namespace tack
