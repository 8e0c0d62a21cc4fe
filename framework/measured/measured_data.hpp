// A measured curve in a scene file, with which a run is compared:
//   follows: {file: load.csv, x_column: opening, y_column: load, from: 5 mm, to: 16 mm}
#pragma once

#include <optional>
#include <string>

#include "framework/config/field.hpp"
#include "framework/measured/deviation.hpp"

namespace tack {

struct MeasuredData {
  std::string file;                // absolute
  std::string x_column, y_column;  // empty: the run's own column names
  std::optional<Quantity> from, to;
  DeviationScale scale = DeviationScale::point;

  void fields(Fields& f);

  // Reads the points from `from` to `to`. `x`, `y`: columns of the run; x_unit, y_unit: their
  // units, or units::any to accept the unit of the file. Throws InputError as read_curve does, and
  // if no point is left.
  MeasuredCurve read(const std::string& x, const Unit& x_unit, const std::string& y,
                     const Unit& y_unit) const;
};

}  // namespace tack
