#include "energies/adhesion/traction_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/quantity_table.hpp"
#include "geometry/curves/smoothed.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr int most_turns = 8;         // of a traction that nobody takes for noise
constexpr double least_turn = 0.005;  // of the largest traction
constexpr double advised = 5;         // reach, in mean distances between turns, but no more than
constexpr double most_advised = 0.1;  // of all gaps

void check_gaps(const QuantityTable& table) {
  const std::vector<double>& gap = table.columns[0];
  if (gap.size() < 2)
    throw InputError(fmt::format("{}: has {} of gaps and tractions; a curve needs two", table.path, gap.empty() ? "no row" : "one row"));
  for (size_t i = 0; i < gap.size(); ++i) {
    if (gap[i] < 0) throw InputError(fmt::format("{}the gap {:.6g} m is negative; gaps count from where surfaces touch", table.location(i), gap[i]));
    if (i > 0 && gap[i] <= gap[i - 1])
      throw InputError(fmt::format("{}the gap {:.6g} m is not above that of the row before, {:.6g} m; sort the rows by gap, and keep one of those with equal gaps",
                                   table.location(i), gap[i], gap[i - 1]));
  }
}

double largest_of(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

// The smoothed table keeps its work, and its end if the traction there is zero.
void smooth_out(const QuantityTable& table, double reach, std::vector<double>& traction) {
  const std::vector<double>& gap = table.columns[0];
  std::vector<double> smooth = smoothed(gap, traction, reach);
  if (smooth == traction)
    throw InputError(fmt::format("{}: smooth: within {:.4g} m of a row there is no other one; raise it, or leave it out", table.path, reach));
  if (traction.back() == 0) smooth.back() = 0;
  const double before = CubicCurve::monotone(gap, traction).total(), after = CubicCurve::monotone(gap, smooth).total();
  if (before > 0 && after > 0)
    for (double& value : smooth) value *= before / after;
  traction = smooth;
}

}  // namespace

void TractionTable::fields(Fields& f) {
  f.path("file", file, "text in columns (CSV) with a line of names and units, `gap [um], traction [kPa]`; relative to the scene file").required();
  f.text("gap_column", gap_column, "name of the column of gaps; gaps ascend, and the last is the range").line();
  f.text("traction_column", traction_column, "name of the column of tractions; positive is attraction").line();
  f.optional_number("smooth", smooth, units::length,
                    "smoothing length against noise: each traction is replaced by a distance-weighted linear fit to "
                    "the rows within this length; all tractions are then scaled to keep the work").positive();
}

TractionTable::Read TractionTable::read() const {
  const QuantityTable table = read_quantities(file, {{gap_column, units::length, "gap_column"}, {traction_column, units::pressure, "traction_column"}});
  check_gaps(table);
  std::vector<double> gap = table.columns[0], traction = table.columns[1];
  if (smooth) smooth_out(table, *smooth, traction);
  Read result;
  result.rows = static_cast<int>(gap.size());
  if (const int count = count_reversals(traction, least_turn * largest_of(traction)); count > most_turns) {
    const double reach = smooth ? 1.5 * *smooth : std::min(advised / count, most_advised) * (gap.back() - gap.front());
    result.doubts.push_back(fmt::format("{}: its traction turns {} times between rising and falling, as noise does: the curve follows it, and surfaces feel its "
                                        "slopes; `smooth: {:.2g} m`, say, averages it", file, count, reach));
  }
  if (gap.front() > 0) gap.insert(gap.begin(), 0.0), traction.insert(traction.begin(), traction.front());
  result.curve = CubicCurve::monotone(gap, traction);
  return result;
}

}  // namespace tack
