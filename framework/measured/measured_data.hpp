// Which part of which file a run is held against. In a scene file:
//   follows: {file: load.csv, x_column: opening, y_column: load, from: 5 mm, to: 16 mm}
#pragma once

#include <optional>
#include <string>

#include "framework/config/field.hpp"
#include "framework/measured/deviation.hpp"

namespace tack {

struct MeasuredData {
  std::string file;                // absolute
  std::string x_column, y_column;  // empty: called as the run's own
  std::optional<Quantity> from, to;
  DeviationScale scale = DeviationScale::point;

  void fields(Fields& f);

  // Its points from `from` to `to`. `x`, `y`: the run's columns and their units; units::any for numbers with whatever unit the file has.
  // Throws InputError as read_curve does, and where no point is left.
  MeasuredCurve read(const std::string& x, const Unit& x_unit, const std::string& y, const Unit& y_unit) const;
};

}  // namespace tack
